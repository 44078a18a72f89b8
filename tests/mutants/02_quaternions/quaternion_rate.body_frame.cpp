// Wrong: multiplies ω from the right, as if it were in body coordinates.
// Killed by: QuaternionRate.IsHalfOmegaTimesQ
// Says: This is ½ q ω
#include "02_quaternions/quaternions.hpp"

namespace spook {

Quat quaternion_rate(const Quat& q, const Vec3& omega) {
  Quat rate = q * Quat(0, omega.x(), omega.y(), omega.z());
  rate.coeffs() *= 0.5;
  return rate;
}

}  // namespace spook
