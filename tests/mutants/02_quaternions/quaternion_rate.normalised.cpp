// Wrong: normalises the rate, because quaternions have length 1.
// Killed by: QuaternionRate.GrowsWithOmega
// Says: the rate is not to be normalised
#include "02_quaternions/quaternions.hpp"

namespace spook {

Quat quaternion_rate(const Quat& q, const Vec3& omega) {
  return (Quat(0, omega.x(), omega.y(), omega.z()) * q).normalized();
}

}  // namespace spook
