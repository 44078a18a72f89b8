// Wrong: takes the conjugate of ω.
// Killed by: QuaternionRate.MovesPointsByOmegaCrossR
// Says: the point moves backwards
#include "02_quaternions/quaternions.hpp"

namespace spook {

Quat quaternion_rate(const Quat& q, const Vec3& omega) {
  Quat rate = Quat(0, omega.x(), omega.y(), omega.z()).conjugate() * q;
  rate.coeffs() *= 0.5;
  return rate;
}

}  // namespace spook
