// Wrong: takes d for a time in seconds.
// Killed by: SpookParameters.WeighTheGapByA
// Says: d counts steps, not seconds
#include "03_single_contact/single_contact.hpp"
#include "common/require.hpp"

namespace spook {

Spook spook_parameters(double h, double k, double d) {
  require_positive("h", h);
  require_positive("k", k);
  require_not_negative("d", d);
  const double upsilon = 1 / (1 + 4 * d / h);
  return {.a = 4 * upsilon / h, .b = 4 * d / h * upsilon, .Sigma = 4 * upsilon / (h * h * k)};
}

}  // namespace spook
