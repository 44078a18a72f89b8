#include "02_quaternions/quaternions.hpp"
#include "common/not_implemented.hpp"

namespace spook {

Mat3 world_inertia(const Quat& q, const Vec3& principal) {
  // Eq. (2.7); what goes in and out, and in which units, is in quaternions.hpp.
  not_implemented("2.4 world_inertia", q, principal);
}

}  // namespace spook
