#include "02_quaternions/quaternions.hpp"
#include "common/not_implemented.hpp"

namespace spook {

void free_rotation(Quat& q, Vec3& omega, const Vec3& principal, double h) {
  // Eq. (2.10), (2.11); what goes in and out, and in which units, is in quaternions.hpp.
  not_implemented("2.6 free_rotation", q, omega, principal, h);
}

}  // namespace spook
