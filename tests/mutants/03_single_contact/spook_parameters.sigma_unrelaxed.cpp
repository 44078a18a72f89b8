// Wrong: leaves the relaxation out of Σ.
// Killed by: SpookParameters.SoftenByStiffnessAndStep
// Says: The 1 + 4d is missing
#include "03_single_contact/single_contact.hpp"
#include "common/require.hpp"

namespace spook {

Spook spook_parameters(double h, double k, double d) {
  require_positive("h", h);
  require_positive("k", k);
  require_not_negative("d", d);
  const double upsilon = 1 / (1 + 4 * d);
  return {.a = 4 * upsilon / h, .b = 4 * d * upsilon, .Sigma = 4 / (h * h * k)};
}

}  // namespace spook
