// Wrong: takes any number.
// Killed by: FrictionBound.RejectsWhatIsNegativeOrNoNumber
// Says: nothing was thrown
#include "05_friction_box/friction_box.hpp"

namespace spook {

double friction_bound(double mu, double mass, double normal_gravity, double h) {
  return mu * mass * normal_gravity * h;
}

}  // namespace spook
