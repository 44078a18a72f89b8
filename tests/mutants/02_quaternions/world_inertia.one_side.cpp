// Wrong: turns the inertia from one side only, like a vector.
// Killed by: WorldInertia.IsTheSumOverTheBodysAxes
// Says: An inertia has two sides to turn
#include "02_quaternions/quaternions.hpp"

namespace spook {

Mat3 world_inertia(const Quat& q, const Vec3& principal) {
  const Mat3 R = q.toRotationMatrix();
  return R * principal.asDiagonal();
}

}  // namespace spook
