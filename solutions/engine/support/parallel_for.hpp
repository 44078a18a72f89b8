#pragma once
// Shares independent work items among threads.
#include <algorithm>
#include <cstddef>

#include "14_fast_rows/fast_rows.hpp"

namespace spook {

/// The largest number of threads of a world.
inline constexpr int most_threads = 256;

/// The number of shares of n items: at most one for each thread, and at least a thousand items in each; at least one
/// share.
inline std::size_t shares_of(int threads, std::size_t n) {
  constexpr std::size_t worth_a_thread = 1000;  // items, of a fraction of a microsecond each
  return std::clamp<std::size_t>(n / worth_a_thread, 1, static_cast<std::size_t>(threads));
}

/// Calls work(share, first, end) for n items in shares_of(threads, n) consecutive shares, at the same time. Throws what
/// a call throws.
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
