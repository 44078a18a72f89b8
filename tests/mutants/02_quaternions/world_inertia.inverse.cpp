// Wrong: returns the inverse inertia, because the equations of motion use that.
// Killed by: WorldInertia.QuarterTurnSwapsTwoMoments
// Says: This is the inverse inertia
#include "02_quaternions/quaternions.hpp"

namespace spook {

Mat3 world_inertia(const Quat& q, const Vec3& principal) {
  const Mat3 R = q.toRotationMatrix();
  return R * principal.cwiseInverse().asDiagonal() * R.transpose();
}

}  // namespace spook
