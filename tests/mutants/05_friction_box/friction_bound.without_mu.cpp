// Wrong: gives the normal impulse.
// Killed by: FrictionBound.IsTheFrictionForceOfAStep
// Says: μ is missing
#include "05_friction_box/friction_box.hpp"
#include "common/require.hpp"

namespace spook {

double friction_bound(double mu, double mass, double normal_gravity, double h) {
  require_not_negative("mu", mu);
  require_not_negative("mass", mass);
  require_not_negative("normal_gravity", normal_gravity);
  require_positive("h", h);
  return mass * normal_gravity * h;
}

}  // namespace spook
