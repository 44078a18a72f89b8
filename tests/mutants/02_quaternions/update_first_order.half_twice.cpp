// Wrong: halves the rate, which has its ½ already.
// Killed by: UpdateFirstOrder.TurnsByTwiceTheArcTangent
// Says: already in quaternion_rate
#include "02_quaternions/quaternions.hpp"

namespace spook {

Quat update_first_order(const Quat& q, const Vec3& omega, double h) {
  Quat next = q;
  next.coeffs() += h / 2 * quaternion_rate(q, omega).coeffs();
  return next.normalized();
}

}  // namespace spook
