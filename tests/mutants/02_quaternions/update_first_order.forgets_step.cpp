// Wrong: moves by the rate of a whole second.
// Killed by: UpdateFirstOrder.TurnsByTwiceTheArcTangent
// Says: h is missing
#include "02_quaternions/quaternions.hpp"

namespace spook {

Quat update_first_order(const Quat& q, const Vec3& omega, double h) {
  (void)h;
  Quat next = q;
  next.coeffs() += quaternion_rate(q, omega).coeffs();
  return next.normalized();
}

}  // namespace spook
