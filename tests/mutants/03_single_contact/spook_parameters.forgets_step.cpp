// Wrong: has no h in a, so that a gap becomes a velocity without a time.
// Killed by: SpookParameters.WeighTheGapByA
// Says: a times a gap [m] must be a velocity
#include "03_single_contact/single_contact.hpp"
#include "common/require.hpp"

namespace spook {

Spook spook_parameters(double h, double k, double d) {
  require_positive("h", h);
  require_positive("k", k);
  require_not_negative("d", d);
  const double upsilon = 1 / (1 + 4 * d);
  return {.a = 4 * upsilon, .b = 4 * d * upsilon, .Sigma = 4 * upsilon / (h * h * k)};
}

}  // namespace spook
