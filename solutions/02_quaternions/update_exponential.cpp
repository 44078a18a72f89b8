#include <cmath>

#include "02_quaternions/quaternions.hpp"

namespace spook {

Quat update_exponential(const Quat& q, const Vec3& omega, double h) {
  const double half_angle = h * omega.norm() / 2;
  // sin(θ/2)/|ω| tends to h/2, and equals h/2 up to round-off long before |ω| can underflow.
  const double scale = std::abs(half_angle) < 1e-8 ? h / 2 : std::sin(half_angle) / omega.norm();
  const Vec3 axis_part = scale * omega;
  const Quat turn(std::cos(half_angle), axis_part.x(), axis_part.y(), axis_part.z());
  // The product of unit quaternions is one, except for a rounding a step, which would add up.
  return (turn * q).normalized();  // Eq. (2.6)
}

}  // namespace spook
