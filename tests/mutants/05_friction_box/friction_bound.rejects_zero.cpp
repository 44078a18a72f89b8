// Wrong: refuses a μ of 0.
// Killed by: FrictionBound.MayBeZero
// Says: mu must be positive
#include "05_friction_box/friction_box.hpp"
#include "common/require.hpp"

namespace spook {

double friction_bound(double mu, double mass, double normal_gravity, double h) {
  require_positive("mu", mu);
  require_not_negative("mass", mass);
  require_not_negative("normal_gravity", normal_gravity);
  require_positive("h", h);
  return mu * mass * normal_gravity * h;
}

}  // namespace spook
