// Wrong: writes the product out with ω on the right.
// Killed by: UpdateFirstOrder.TurnsByTwiceTheArcTangent
// Says: (h/2) q ω
#include "02_quaternions/quaternions.hpp"

namespace spook {

Quat update_first_order(const Quat& q, const Vec3& omega, double h) {
  Quat next = q;
  next.coeffs() += h / 2 * (q * Quat(0, omega.x(), omega.y(), omega.z())).coeffs();
  return next.normalized();
}

}  // namespace spook
