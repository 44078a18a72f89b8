#include "02_quaternions/quaternions.hpp"

namespace spook {

Quat update_first_order(const Quat& q, const Vec3& omega, double h) {
  Quat next = q;
  next.coeffs() += h * quaternion_rate(q, omega).coeffs();
  return next.normalized();  // Eq. (2.4)
}

}  // namespace spook
