// Wrong: cuts the exponential series short.
// Killed by: UpdateExponential.MakesSeveralTurnsInOneStep
// Says: not a truncated series
#include "02_quaternions/quaternions.hpp"

namespace spook {

Quat update_exponential(const Quat& q, const Vec3& omega, double h) {
  const Vec3 v = h / 2 * omega;
  const double square = v.squaredNorm();
  const Vec3 axis_part = (1 - square / 6) * v;
  return (Quat(1 - square / 2, axis_part.x(), axis_part.y(), axis_part.z()) * q).normalized();
}

}  // namespace spook
