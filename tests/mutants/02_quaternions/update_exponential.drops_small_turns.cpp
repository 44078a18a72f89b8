// Wrong: returns q when ω is small, to be safe from 0/0.
// Killed by: UpdateExponential.DropsNoSmallTurn
// Says: The turn was dropped for being small
#include <cmath>

#include "02_quaternions/quaternions.hpp"

namespace spook {

Quat update_exponential(const Quat& q, const Vec3& omega, double h) {
  if (omega.norm() < 1e-6) return q;
  const double angle = h * omega.norm();
  const Vec3 v = std::sin(angle / 2) / omega.norm() * omega;
  const Quat turn(std::cos(angle / 2), v.x(), v.y(), v.z());
  return (turn * q).normalized();
}

}  // namespace spook
