// Wrong: hands in exercise 2.2 again.
// Killed by: UpdateExponential.ClosesTheCircleInAnyNumberOfSteps
// Says: The circle stays open
#include "02_quaternions/quaternions.hpp"

namespace spook {

Quat update_exponential(const Quat& q, const Vec3& omega, double h) {
  Quat next = q;
  next.coeffs() += h * quaternion_rate(q, omega).coeffs();
  return next.normalized();
}

}  // namespace spook
