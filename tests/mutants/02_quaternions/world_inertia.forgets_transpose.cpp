// Wrong: multiplies by R on both sides.
// Killed by: WorldInertia.IsTheSumOverTheBodysAxes
// Says: the right one must be transposed
#include "02_quaternions/quaternions.hpp"

namespace spook {

Mat3 world_inertia(const Quat& q, const Vec3& principal) {
  const Mat3 R = q.toRotationMatrix();
  return R * principal.asDiagonal() * R;
}

}  // namespace spook
