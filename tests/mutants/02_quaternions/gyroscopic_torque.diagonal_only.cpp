// Wrong: writes Euler's equations of the body's axes with a matrix of the world.
// Killed by: GyroscopicTorque.IsMinusOmegaCrossL
// Says: Only the diagonal of the inertia
#include "02_quaternions/quaternions.hpp"

namespace spook {

Vec3 gyroscopic_torque(const Mat3& inertia, const Vec3& omega) {
  const Vec3 L = inertia.diagonal().cwiseProduct(omega);
  return -omega.cross(L);
}

}  // namespace spook
