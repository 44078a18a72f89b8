// Wrong: forbids d = 0, which is a contact without any damping.
// Killed by: SpookParameters.NeedNoRelaxation
// Says: d must be positive
#include "03_single_contact/single_contact.hpp"
#include "common/require.hpp"

namespace spook {

Spook spook_parameters(double h, double k, double d) {
  require_positive("h", h);
  require_positive("k", k);
  require_positive("d", d);
  const double upsilon = 1 / (1 + 4 * d);
  return {.a = 4 * upsilon / h, .b = 4 * d * upsilon, .Sigma = 4 * upsilon / (h * h * k)};
}

}  // namespace spook
