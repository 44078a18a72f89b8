#pragma once
// Shares independent work items among threads.
#include <algorithm>
#include <cstddef>

#include "14_fast_rows/fast_rows.hpp"

namespace spook {

/// The most threads that a world may be given.
inline constexpr int most_threads = 256;

/// How many shares so many threads make of n things: no more than have a thousand things each, and one at least.
inline std::size_t shares_of(int threads, std::size_t n) {
  constexpr std::size_t worth_a_thread = 1000;  // of a fraction of a microsecond each
  return std::clamp<std::size_t>(n / worth_a_thread, 1, static_cast<std::size_t>(threads));
}

/// Calls work(share, first, end) for n things in that many shares, at the same time. Share by share they are in order.
/// What one throws is thrown.
template <class Work>
void parallel_for(int threads, std::size_t n, const Work& work) {
  const std::size_t shares = shares_of(threads, n);
  if (shares == 1) return work(0, 0, n);
  const auto of_thread = [&](int thread) {
    const auto t = static_cast<std::size_t>(thread);
    work(t, n * t / shares, n * (t + 1) / shares);  // Eq. (14.10)
  };
  in_rounds(static_cast<int>(shares), of_thread, [] { return false; });
}

}  // namespace spook
