// Wrong: looks at the last two.
// Killed by: ObservedRate.LooksAtTheSecondHalf
// Says: the last two entries alone
#include <cmath>

#include "10_convergence/convergence.hpp"

namespace spook {

double observed_rate(const std::vector<double>& history) {
  const std::size_t n = history.size();
  if (n < 2) return std::nan("");
  const std::size_t m = n - 1;
  const double first = history[m - 1], last = history[n - 1];
  if (!(first > 0 && last > 0)) return std::nan("");
  return std::pow(last / first, 1.0 / static_cast<double>(n - m));  // Eq. (10.5)
}

}  // namespace spook
