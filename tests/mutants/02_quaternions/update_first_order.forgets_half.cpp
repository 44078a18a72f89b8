// Wrong: writes the product out, and the ½ not.
// Killed by: UpdateFirstOrder.FallsShortByATwelfthOfTheSquare
// Says: turns twice as far
#include "02_quaternions/quaternions.hpp"

namespace spook {

Quat update_first_order(const Quat& q, const Vec3& omega, double h) {
  Quat next = q;
  next.coeffs() += h * (Quat(0, omega.x(), omega.y(), omega.z()) * q).coeffs();
  return next.normalized();
}

}  // namespace spook
