// Wrong: multiplies the turn from the right.
// Killed by: UpdateExponential.TurnsByTheWholeAngleAboutOmega
// Says: The turn was multiplied from the right
#include <cmath>

#include "02_quaternions/quaternions.hpp"

namespace spook {

Quat update_exponential(const Quat& q, const Vec3& omega, double h) {
  const double angle = h * omega.norm();
  const Vec3 axis = omega.normalized();
  const Vec3 v = std::sin(angle / 2) * axis;
  const Quat turn(std::cos(angle / 2), v.x(), v.y(), v.z());
  return (q * turn).normalized();
}

}  // namespace spook
