// Wrong: looks at the whole history.
// Killed by: ObservedRate.LooksAtTheSecondHalf
// Says: over the whole history
#include <cmath>

#include "10_convergence/convergence.hpp"

namespace spook {

double observed_rate(const std::vector<double>& history) {
  const std::size_t n = history.size();
  if (n < 2) return std::nan("");
  const std::size_t m = 1;
  const double first = history[m - 1], last = history[n - 1];
  if (!(first > 0 && last > 0)) return std::nan("");
  return std::pow(last / first, 1.0 / static_cast<double>(n - m));  // Eq. (10.5)
}

}  // namespace spook
