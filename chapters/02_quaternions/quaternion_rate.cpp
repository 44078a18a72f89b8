#include "02_quaternions/quaternions.hpp"
#include "common/not_implemented.hpp"

namespace spook {

Quat quaternion_rate(const Quat& q, const Vec3& omega) {
  // Eq. (2.3); what goes in and out, and in which units, is in quaternions.hpp.
  not_implemented("2.1 quaternion_rate", q, omega);
}

}  // namespace spook
