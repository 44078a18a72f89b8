// Wrong: trusts the product of two unit quaternions to be one.
// Killed by: UpdateExponential.LetsNoRoundingsOfTheLengthAddUp
// Says: those add up: normalise it
#include <cmath>

#include "02_quaternions/quaternions.hpp"

namespace spook {

Quat update_exponential(const Quat& q, const Vec3& omega, double h) {
  const double half_angle = h * omega.norm() / 2;
  const double scale = std::abs(half_angle) < 1e-8 ? h / 2 : std::sin(half_angle) / omega.norm();
  const Vec3 v = scale * omega;
  return Quat(std::cos(half_angle), v.x(), v.y(), v.z()) * q;
}

}  // namespace spook
