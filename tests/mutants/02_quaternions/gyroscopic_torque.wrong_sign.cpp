// Wrong: has it on the wrong side of Iω' = τ.
// Killed by: GyroscopicTorque.IsEulersInBodyAxes
// Says: this is +ω × Iω
#include "02_quaternions/quaternions.hpp"

namespace spook {

Vec3 gyroscopic_torque(const Mat3& inertia, const Vec3& omega) {
  return omega.cross(inertia * omega);
}

}  // namespace spook
