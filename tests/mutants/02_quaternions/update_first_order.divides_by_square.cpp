// Wrong: divides by |q|² where |q| belongs.
// Killed by: UpdateFirstOrder.TurnsByTwiceTheArcTangent
// Says: not by its square
#include "02_quaternions/quaternions.hpp"

namespace spook {

Quat update_first_order(const Quat& q, const Vec3& omega, double h) {
  Quat next = q;
  next.coeffs() += h * quaternion_rate(q, omega).coeffs();
  next.coeffs() /= next.squaredNorm();
  return next;
}

}  // namespace spook
