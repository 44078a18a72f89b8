// Wrong: keeps μ below 1.
// Killed by: FrictionBound.IsProportionalToEach
// Says: it may be more
#include "05_friction_box/friction_box.hpp"
#include "common/require.hpp"

namespace spook {

double friction_bound(double mu, double mass, double normal_gravity, double h) {
  require_not_negative("mu", mu);
  require_not_negative("mass", mass);
  require_not_negative("normal_gravity", normal_gravity);
  require_positive("h", h);
  return (mu < 1 ? mu : 1) * mass * normal_gravity * h;
}

}  // namespace spook
