#include "02_quaternions/quaternions.hpp"
#include "common/not_implemented.hpp"

namespace spook {

Quat update_first_order(const Quat& q, const Vec3& omega, double h) {
  // Eq. (2.4); what goes in and out, and in which units, is in quaternions.hpp.
  not_implemented("2.2 update_first_order", q, omega, h);
}

}  // namespace spook
