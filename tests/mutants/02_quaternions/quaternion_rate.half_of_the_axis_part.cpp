// Wrong: halves x, y and z, and forgets w.
// Killed by: QuaternionRate.IsHalfOmegaTimesQ
// Says: here w has not got it
#include "02_quaternions/quaternions.hpp"

namespace spook {

Quat quaternion_rate(const Quat& q, const Vec3& omega) {
  Quat rate = Quat(0, omega.x(), omega.y(), omega.z()) * q;
  rate.vec() *= 0.5;
  return rate;
}

}  // namespace spook
