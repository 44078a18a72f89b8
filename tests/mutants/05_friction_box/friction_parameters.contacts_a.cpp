// Wrong: weighs a gap, as a contact does.
// Killed by: FrictionParameters.WeighNoGap
// Says: A friction row has no gap
#include "05_friction_box/friction_box.hpp"
#include "common/require.hpp"

namespace spook {

Spook friction_parameters(double h, double c) {
  require_positive("h", h);
  if (!(c > 0)) reject("c", c, "positive; it may be infinite");
  return {.a = 1 / h, .b = 1, .Sigma = 1 / (h * c)};
}

}  // namespace spook
