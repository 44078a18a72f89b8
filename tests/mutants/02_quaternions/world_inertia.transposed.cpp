// Wrong: turns from world to body: Rᵀ I R.
// Killed by: WorldInertia.IsTheSumOverTheBodysAxes
// Says: This is Rᵀ I R
#include "02_quaternions/quaternions.hpp"

namespace spook {

Mat3 world_inertia(const Quat& q, const Vec3& principal) {
  const Mat3 R = q.toRotationMatrix();
  return R.transpose() * principal.asDiagonal() * R;
}

}  // namespace spook
