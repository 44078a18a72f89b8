// Wrong: takes any c.
// Killed by: FrictionParameters.RejectAViscosityThatIsNotPositive
// Says: nothing was thrown
#include "05_friction_box/friction_box.hpp"
#include "common/require.hpp"

namespace spook {

Spook friction_parameters(double h, double c) {
  require_positive("h", h);
  return {.a = 0, .b = 1, .Sigma = 1 / (h * c)};
}

}  // namespace spook
