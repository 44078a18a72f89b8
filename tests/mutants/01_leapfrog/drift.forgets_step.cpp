// Wrong: adds the velocity to the position.
// Killed by: Drift.MovesByVelocityTimesStep
// Says: h is missing
#include "01_leapfrog/leapfrog.hpp"

namespace spook {

Vec3 drift(const Vec3& x, const Vec3& v, double h) {
  (void)h;
  return x + v;
}

}  // namespace spook
