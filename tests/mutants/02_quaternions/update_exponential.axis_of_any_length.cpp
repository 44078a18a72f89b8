// Wrong: takes ω for the axis, as if it had length 1.
// Killed by: UpdateExponential.TurnsByTheWholeAngleAboutOmega
// Says: The axis has the length |ω|
#include <cmath>

#include "02_quaternions/quaternions.hpp"

namespace spook {

Quat update_exponential(const Quat& q, const Vec3& omega, double h) {
  const double angle = h * omega.norm();
  const Vec3 v = std::sin(angle / 2) * omega;
  const Quat turn(std::cos(angle / 2), v.x(), v.y(), v.z());
  return turn * q;
}

}  // namespace spook
