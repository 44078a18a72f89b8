// Wrong: adds a drag, to be rid of the energy that explicit steps gain.
// Killed by: GyroscopicTorque.DoesNoWork
// Says: nothing feeds a body that spins freely
#include "02_quaternions/quaternions.hpp"

namespace spook {

Vec3 gyroscopic_torque(const Mat3& inertia, const Vec3& omega) {
  const Vec3 L = inertia * omega;
  return -omega.cross(L) - 0.1 * L;
}

}  // namespace spook
