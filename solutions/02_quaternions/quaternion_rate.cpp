#include "02_quaternions/quaternions.hpp"

namespace spook {

Quat quaternion_rate(const Quat& q, const Vec3& omega) {
  Quat rate = Quat(0, omega.x(), omega.y(), omega.z()) * q;
  rate.coeffs() *= 0.5;  // Eq. (2.3)
  return rate;
}

}  // namespace spook
