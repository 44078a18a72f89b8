// Wrong: refuses an infinite c.
// Killed by: FrictionParameters.MayBeRigid
// Says: c must be positive and finite
#include "05_friction_box/friction_box.hpp"
#include "common/require.hpp"

namespace spook {

Spook friction_parameters(double h, double c) {
  require_positive("h", h);
  require_positive("c", c);
  return {.a = 0, .b = 1, .Sigma = 1 / (h * c)};
}

}  // namespace spook
