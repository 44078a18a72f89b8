// Wrong: normalises what came in, not what goes out.
// Killed by: UpdateFirstOrder.TurnsByTwiceTheArcTangent
// Says: normalise the sum
#include "02_quaternions/quaternions.hpp"

namespace spook {

Quat update_first_order(const Quat& q, const Vec3& omega, double h) {
  Quat next = q.normalized();
  next.coeffs() += h * quaternion_rate(next, omega).coeffs();
  return next;
}

}  // namespace spook
