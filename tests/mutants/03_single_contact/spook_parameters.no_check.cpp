// Wrong: takes any parameters, also those that are not numbers.
// Killed by: SpookParameters.RejectAStepThatIsNotPositive
// Says: nothing was thrown
#include "03_single_contact/single_contact.hpp"

namespace spook {

Spook spook_parameters(double h, double k, double d) {
  const double upsilon = 1 / (1 + 4 * d);
  return {.a = 4 * upsilon / h, .b = 4 * d * upsilon, .Sigma = 4 * upsilon / (h * h * k)};
}

}  // namespace spook
