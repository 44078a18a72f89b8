#pragma once
// Functions on bounds that both broad phases use.
#include "08_pairs/pairs.hpp"

namespace spook {

/// Tells whether two bounds overlap, or share at least a point.
inline bool touch(const Bounds& a, const Bounds& b) {
  bool all = true;  // & and not &&: six comparisons cost less than one branch that is guessed wrong
  for (int k = 0; k < 3; ++k) {
    all &= a.lower[k] <= b.upper[k];
    all &= b.lower[k] <= a.upper[k];
  }
  return all;
}

/// Throws std::invalid_argument, naming lower or upper, unless all bounds are finite and no upper is below its lower.
void require_sound(const std::vector<Bounds>& bounds);

/// Sorts pairs of numbers below `n` by counting. This takes as many operations as there are pairs and numbers;
/// std::sort took a fifth of a broad phase.
void sort_pairs(std::vector<Pair>& pairs, std::size_t n);

}  // namespace spook
