// Wrong: builds the quaternion in the order in which Eigen stores it, (x, y, z, w).
// Killed by: UpdateExponential.TurnsByTheWholeAngleAboutOmega
// Says: takes w first
#include <cmath>

#include "02_quaternions/quaternions.hpp"

namespace spook {

Quat update_exponential(const Quat& q, const Vec3& omega, double h) {
  const double angle = h * omega.norm();
  const Vec3 v = std::sin(angle / 2) * omega.normalized();
  return (Quat(v.x(), v.y(), v.z(), std::cos(angle / 2)) * q).normalized();
}

}  // namespace spook
