// Wrong: returns the change instead of the new position.
// Killed by: Drift.MovesByVelocityTimesStep
// Says: the change alone
#include "01_leapfrog/leapfrog.hpp"

namespace spook {

Vec3 drift(const Vec3& x, const Vec3& v, double h) {
  (void)x;
  return h * v;
}

}  // namespace spook
