#include "engine/shares.hpp"

#include <algorithm>

#include "14_fast_rows/fast_rows.hpp"

namespace spook {

static constexpr std::size_t worth_a_thread = 1000;  // things of a fraction of a microsecond each

std::size_t shares_of(int threads, std::size_t n) {
  return std::clamp<std::size_t>(n / worth_a_thread, 1, static_cast<std::size_t>(threads));
}

void in_shares(int threads, std::size_t n,
               const std::function<void(std::size_t share, std::size_t first, std::size_t end)>& work) {
  const std::size_t shares = shares_of(threads, n);
  const auto of_thread = [&](int thread) {
    const auto t = static_cast<std::size_t>(thread);
    work(t, n * t / shares, n * (t + 1) / shares);  // Eq. (14.10)
  };
  in_rounds(static_cast<int>(shares), of_thread, [] { return false; });
}

}  // namespace spook
