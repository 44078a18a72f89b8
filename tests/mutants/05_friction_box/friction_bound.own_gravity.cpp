// Wrong: takes 9.81 m/s² whatever comes in, which on a slope is too much.
// Killed by: FrictionBound.HoldsABlockUpToTanTheta
// Says: too large
#include "05_friction_box/friction_box.hpp"
#include "common/require.hpp"

namespace spook {

double friction_bound(double mu, double mass, double normal_gravity, double h) {
  require_not_negative("mu", mu);
  require_not_negative("mass", mass);
  require_not_negative("normal_gravity", normal_gravity);
  require_positive("h", h);
  return mu * mass * 9.81 * h;
}

}  // namespace spook
