// Wrong: takes for b the share of the velocity that stays.
// Killed by: SpookParameters.WeighTheVelocityByB
// Says: b is the share that goes
#include "03_single_contact/single_contact.hpp"
#include "common/require.hpp"

namespace spook {

Spook spook_parameters(double h, double k, double d) {
  require_positive("h", h);
  require_positive("k", k);
  require_not_negative("d", d);
  const double upsilon = 1 / (1 + 4 * d);
  return {.a = 4 * upsilon / h, .b = upsilon, .Sigma = 4 * upsilon / (h * h * k)};
}

}  // namespace spook
