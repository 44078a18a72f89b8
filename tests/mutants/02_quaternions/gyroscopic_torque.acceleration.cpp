// Wrong: divides by the inertia, too.
// Killed by: GyroscopicTorque.IsMinusOmegaCrossL
// Says: it is an acceleration
#include <Eigen/LU>

#include "02_quaternions/quaternions.hpp"

namespace spook {

Vec3 gyroscopic_torque(const Mat3& inertia, const Vec3& omega) {
  return -(inertia.inverse() * omega.cross(inertia * omega));
}

}  // namespace spook
