// Wrong: adds the step, and leaves q longer than before.
// Killed by: UpdateFirstOrder.KeepsUnitLengthFor1001Steps
// Says: it follows the tangent and never comes back
#include "02_quaternions/quaternions.hpp"

namespace spook {

Quat update_first_order(const Quat& q, const Vec3& omega, double h) {
  Quat next = q;
  next.coeffs() += h * quaternion_rate(q, omega).coeffs();
  return next;
}

}  // namespace spook
