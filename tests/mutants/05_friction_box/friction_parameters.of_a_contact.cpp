// Wrong: reuses a contact's numbers, with c for the stiffness.
// Killed by: FrictionParameters.LetAStuckBodyCreepAtFOverC
// Says: F/(k d h)
#include "05_friction_box/friction_box.hpp"

namespace spook {

Spook friction_parameters(double h, double c) {
  return spook_parameters(h, c, 3);
}

}  // namespace spook
