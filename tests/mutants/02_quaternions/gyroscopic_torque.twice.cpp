// Wrong: adds Iω × ω and -ω × Iω, which are the same.
// Killed by: GyroscopicTorque.KeepsLToFirstOrder
// Says: look at sign and factors
#include "02_quaternions/quaternions.hpp"

namespace spook {

Vec3 gyroscopic_torque(const Mat3& inertia, const Vec3& omega) {
  const Vec3 L = inertia * omega;
  return L.cross(omega) - omega.cross(L);
}

}  // namespace spook
