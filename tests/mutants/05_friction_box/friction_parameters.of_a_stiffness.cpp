// Wrong: softens by h² c, as if c were a stiffness.
// Killed by: FrictionParameters.LetAStuckBodyCreepAtFOverC
// Says: one h too many
#include "05_friction_box/friction_box.hpp"
#include "common/require.hpp"

namespace spook {

Spook friction_parameters(double h, double c) {
  require_positive("h", h);
  if (!(c > 0)) reject("c", c, "positive; it may be infinite");
  return {.a = 0, .b = 1, .Sigma = 1 / (h * h * c)};
}

}  // namespace spook
