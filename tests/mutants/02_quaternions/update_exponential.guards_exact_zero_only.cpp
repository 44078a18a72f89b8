// Wrong: guards against ω = 0, but |ω|² is 0 before that.
// Killed by: UpdateExponential.LeavesABodyAtRestAlone
// Says: |ω|² is 0 long before ω is
#include <cmath>

#include "02_quaternions/quaternions.hpp"

namespace spook {

Quat update_exponential(const Quat& q, const Vec3& omega, double h) {
  if (omega == Vec3::Zero()) return q;
  const double angle = h * omega.norm();
  const Vec3 v = std::sin(angle / 2) / omega.norm() * omega;
  const Quat turn(std::cos(angle / 2), v.x(), v.y(), v.z());
  return (turn * q).normalized();
}

}  // namespace spook
