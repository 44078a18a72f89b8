// Wrong: leaves some of the velocity to the next steps, as a contact does.
// Killed by: FrictionParameters.WeighTheVelocityInFull
// Says: all of the velocity is to go at once
#include "05_friction_box/friction_box.hpp"
#include "common/require.hpp"

namespace spook {

Spook friction_parameters(double h, double c) {
  require_positive("h", h);
  if (!(c > 0)) reject("c", c, "positive; it may be infinite");
  const double d = 3;
  return {.a = 0, .b = 4 * d / (1 + 4 * d), .Sigma = 1 / (h * c)};
}

}  // namespace spook
