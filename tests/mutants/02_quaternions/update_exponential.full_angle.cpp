// Wrong: takes sine and cosine of the whole angle.
// Killed by: UpdateExponential.TurnsByTheWholeAngleAboutOmega
// Says: Twice the angle
#include <cmath>

#include "02_quaternions/quaternions.hpp"

namespace spook {

Quat update_exponential(const Quat& q, const Vec3& omega, double h) {
  const double angle = h * omega.norm();
  const Vec3 axis = omega.normalized();
  const Vec3 v = std::sin(angle) * axis;
  const Quat turn(std::cos(angle), v.x(), v.y(), v.z());
  return (turn * q).normalized();
}

}  // namespace spook
