// Wrong: returns the whole drop.
// Killed by: ObservedRate.OfAGeometricHistoryIsItsFactor
// Says: This is the whole drop
#include <cmath>

#include "10_convergence/convergence.hpp"

namespace spook {

double observed_rate(const std::vector<double>& history) {
  const std::size_t n = history.size();
  if (n < 2) return std::nan("");
  const std::size_t m = (n + 1) / 2;  // both count from 1, as sweeps do
  const double first = history[m - 1], last = history[n - 1];
  if (!(first > 0 && last > 0)) return std::nan("");
  return last / first;  // Eq. (10.5)
}

}  // namespace spook
