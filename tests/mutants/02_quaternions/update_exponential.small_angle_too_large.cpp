// Wrong: takes angles for small whose sine is not the angle to a rounding.
// Killed by: UpdateExponential.DropsNoSmallTurn
// Says: may not be left out
#include <cmath>

#include "02_quaternions/quaternions.hpp"

namespace spook {

Quat update_exponential(const Quat& q, const Vec3& omega, double h) {
  const double half_angle = h * omega.norm() / 2;
  const double scale = std::abs(half_angle) < 1e-4 ? h / 2 : std::sin(half_angle) / omega.norm();
  const Vec3 v = scale * omega;
  return (Quat(std::cos(half_angle), v.x(), v.y(), v.z()) * q).normalized();
}

}  // namespace spook
