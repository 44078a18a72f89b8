#include "02_quaternions/quaternions.hpp"

namespace spook {

Mat3 world_inertia(const Quat& q, const Vec3& principal) {
  const Mat3 R = q.toRotationMatrix();
  return R * principal.asDiagonal() * R.transpose();  // Eq. (2.7)
}

}  // namespace spook
