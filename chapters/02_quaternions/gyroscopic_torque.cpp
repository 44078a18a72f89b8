#include "02_quaternions/quaternions.hpp"
#include "common/not_implemented.hpp"

namespace spook {

Vec3 gyroscopic_torque(const Mat3& inertia, const Vec3& omega) {
  // Eq. (2.9); what goes in and out, and in which units, is in quaternions.hpp.
  not_implemented("2.5 gyroscopic_torque", inertia, omega);
}

}  // namespace spook
