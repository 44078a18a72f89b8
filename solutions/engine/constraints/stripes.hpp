#pragma once
// Stripes: bodies side by side, for sweeps on several threads.
//
//   stripes    n bodies are divided into ∛n/2 stripes, a multiple of four from four on, with equal numbers of items:
//              in a cube a stripe is two bodies wide
//   an item    a row or a contact. It belongs to the first stripe that contains one of its bodies; most items reach at
//              most into the next one
//   a sweep    has rounds: all even stripes in parallel, then all odd stripes in parallel; then, on one thread, the
//              items that reach farther
//
// Items of parallel stripes share no dynamic body. So the result is the same to the last bit for any number of threads.
// With two rounds a sweep, threads wait less for each other than with a round for each colour of chapter 14.
#include <utility>
#include <vector>

#include "engine/bodies/bodies.hpp"

namespace spook {

/// The items of each stripe, in ascending order. The last list has those that reach farther.
using Stripes = std::vector<std::vector<int>>;

/// Divides items, whose two bodies are `ends`.
template <int Dof>
Stripes divide_into_stripes(const std::vector<std::pair<int, int>>& ends, const Bodies<Dof>& bodies,
                            int threads);

/// The number of rounds of a sweep.
inline int rounds_of(const Stripes& stripes) {
  return stripes.back().empty() ? 2 : 3;
}

/// The number of threads that stripes of `items` can use.
int threads_for(const Stripes& stripes, std::size_t items, int threads);

/// Calls sweep(stripe) for each stripe that thread number `thread` of `threads` sweeps in a round.
template <class Sweep>
void sweep_in_round(int round, int thread, int threads, const Stripes& stripes, const Sweep& sweep) {
  const int rest = static_cast<int>(stripes.size()) - 1;
  if (round == 2) {
    if (thread == 0) sweep(rest);
    return;
  }
  const int n = (rest + 1 - round) / 2;  // even stripes, or odd stripes
  for (int k = n * thread / threads; k < n * (thread + 1) / threads; ++k) sweep(2 * k + round);
}

}  // namespace spook
