// Wrong: divides by |ω|, also when it is 0.
// Killed by: UpdateExponential.LeavesABodyAtRestAlone
// Says: ω/|ω| is 0/0 at rest
#include <cmath>

#include "02_quaternions/quaternions.hpp"

namespace spook {

Quat update_exponential(const Quat& q, const Vec3& omega, double h) {
  const double angle = h * omega.norm();
  const Vec3 v = std::sin(angle / 2) / omega.norm() * omega;
  const Quat turn(std::cos(angle / 2), v.x(), v.y(), v.z());
  return (turn * q).normalized();
}

}  // namespace spook
