#include "02_quaternions/quaternions.hpp"
#include "common/not_implemented.hpp"

namespace spook {

Quat update_exponential(const Quat& q, const Vec3& omega, double h) {
  // Eq. (2.6); what goes in and out, and in which units, is in quaternions.hpp.
  not_implemented("2.3 update_exponential", q, omega, h);
}

}  // namespace spook
