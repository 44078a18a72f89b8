// Wrong: drifts for half a step, to meet the velocity in the middle.
// Killed by: Drift.MovesByVelocityTimesStep
// Says: Leapfrog drifts by whole steps
#include "01_leapfrog/leapfrog.hpp"

namespace spook {

Vec3 drift(const Vec3& x, const Vec3& v, double h) {
  return x + h / 2 * v;
}

}  // namespace spook
