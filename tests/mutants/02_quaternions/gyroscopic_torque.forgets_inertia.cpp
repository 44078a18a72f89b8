// Wrong: crosses ω with itself.
// Killed by: GyroscopicTorque.IsMinusOmegaCrossL
// Says: the cross product of ω with itself
#include "02_quaternions/quaternions.hpp"

namespace spook {

Vec3 gyroscopic_torque(const Mat3& inertia, const Vec3& omega) {
  return -omega.cross(Vec3(inertia.trace() / 3 * omega));
}

}  // namespace spook
