// Wrong: leaves out the ½.
// Killed by: QuaternionRate.IsHalfOmegaForAnUnturnedBody
// Says: the ½ is missing
#include "02_quaternions/quaternions.hpp"

namespace spook {

Quat quaternion_rate(const Quat& q, const Vec3& omega) {
  return Quat(0, omega.x(), omega.y(), omega.z()) * q;
}

}  // namespace spook
