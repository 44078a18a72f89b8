// Wrong: has no rate for a history with any entry that is not positive.
// Killed by: ObservedRate.AsksNothingOfTheOthers
// Says: the others have no part in it
#include <cmath>

#include "10_convergence/convergence.hpp"

namespace spook {

double observed_rate(const std::vector<double>& history) {
  const std::size_t n = history.size();
  if (n < 2) return std::nan("");
  for (const double e : history)
    if (!(e > 0)) return std::nan("");
  const std::size_t m = (n + 1) / 2;  // both count from 1, as sweeps do
  const double first = history[m - 1], last = history[n - 1];
  if (!(first > 0 && last > 0)) return std::nan("");
  return std::pow(last / first, 1.0 / static_cast<double>(n - m));  // Eq. (10.5)
}

}  // namespace spook
