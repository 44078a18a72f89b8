#include "02_quaternions/quaternions.hpp"

namespace spook {

Vec3 gyroscopic_torque(const Mat3& inertia, const Vec3& omega) {
  return -omega.cross(inertia * omega);  // Eq. (2.9)
}

}  // namespace spook
