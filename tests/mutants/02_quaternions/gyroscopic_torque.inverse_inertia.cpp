// Wrong: takes I⁻¹ω for L.
// Killed by: GyroscopicTorque.IsMinusOmegaCrossL
// Says: L is Iω, not I⁻¹ω
#include <Eigen/LU>

#include "02_quaternions/quaternions.hpp"

namespace spook {

Vec3 gyroscopic_torque(const Mat3& inertia, const Vec3& omega) {
  return -omega.cross(inertia.inverse() * omega);
}

}  // namespace spook
