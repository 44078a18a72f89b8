// Wrong: takes m for an index that counts from 0.
// Killed by: ObservedRate.LooksAtTheSecondHalf
// Says: one entry too late
#include <cmath>

#include "10_convergence/convergence.hpp"

namespace spook {

double observed_rate(const std::vector<double>& history) {
  const std::size_t n = history.size();
  if (n < 3) return std::nan("");
  const std::size_t m = (n + 1) / 2;  // both count from 1, as sweeps do
  const double first = history[m], last = history[n - 1];
  if (!(first > 0 && last > 0)) return std::nan("");
  return std::pow(last / first, 1.0 / static_cast<double>(n - 1 - m));  // Eq. (10.5)
}

}  // namespace spook
