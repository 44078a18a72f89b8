#pragma once
// Pairs of near solids, kept from step to step.
//
// Most bodies move little in a step. A broad phase finds the pairs of enlarged bounds. As long as no body has left its
// enlarged bounds, no other pair can touch. If at most 100 bodies have left, they get new bounds, which are compared
// with all others; otherwise the broad phase starts again.
#include <vector>

#include "08_pairs/pairs.hpp"

namespace spook {

class PairCache {
 public:
  /// Returns the pairs whose bounds touch, in order. Throws std::invalid_argument, naming lower or upper, if one is not
  /// finite.
  const std::vector<Pair>& touching(const std::vector<Bounds>& bounds);

 private:
  void enlarge_all(const std::vector<Bounds>& bounds);
  void enlarge(const std::vector<int>& these, const std::vector<Bounds>& bounds);

  std::vector<Bounds> enlarged_;  // enlarged bounds; near_ are the pairs of them that touch
  std::vector<Pair> near_, touching_;
};

}  // namespace spook
