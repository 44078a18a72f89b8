// Wrong: builds the quaternion in the order in which Eigen stores it, (x, y, z, w).
// Killed by: QuaternionRate.IsAtRightAnglesToQ
// Says: ω has a real part
#include "02_quaternions/quaternions.hpp"

namespace spook {

Quat quaternion_rate(const Quat& q, const Vec3& omega) {
  Quat rate = Quat(omega.x(), omega.y(), omega.z(), 0) * q;
  rate.coeffs() *= 0.5;
  return rate;
}

}  // namespace spook
