// Wrong: has b = 0, so that the row answers to forces alone.
// Killed by: FrictionParameters.BrakeWhatSlides
// Says: Nothing brakes it
#include "05_friction_box/friction_box.hpp"
#include "common/require.hpp"

namespace spook {

Spook friction_parameters(double h, double c) {
  require_positive("h", h);
  if (!(c > 0)) reject("c", c, "positive; it may be infinite");
  return {.a = 0, .b = 0, .Sigma = 1 / (h * c)};
}

}  // namespace spook
