// Wrong: checks the step, and trusts the rest.
// Killed by: SpookParameters.RejectAStiffnessThatIsNotPositive
// Says: nothing was thrown
#include "03_single_contact/single_contact.hpp"
#include "common/require.hpp"

namespace spook {

Spook spook_parameters(double h, double k, double d) {
  require_positive("h", h);
  const double upsilon = 1 / (1 + 4 * d);
  return {.a = 4 * upsilon / h, .b = 4 * d * upsilon, .Sigma = 4 * upsilon / (h * h * k)};
}

}  // namespace spook
