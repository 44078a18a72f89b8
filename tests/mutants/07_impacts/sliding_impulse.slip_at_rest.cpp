// Wrong: compares |u_t| with 1e-12 |u| by <, which at rest is 0 < 0.
// Killed by: SlidingImpulse.IsAlongTheNormalWithoutSlip
// Says: At rest the slip is 0
#include "07_impacts/impacts.hpp"

namespace spook {

std::optional<Vec3> sliding_impulse(const Mat3& K, const Vec3& u, const Vec3& n, double e, double mu) {
  const Vec3 slip = u - u.dot(n) * n;
  const double speed = slip.norm();
  const Vec3 t = speed < 1e-12 * u.norm() ? Vec3(Vec3::Zero()) : Vec3(slip / speed);
  const Vec3 direction = n - mu * t;
  const double eased = n.dot(K * direction);
  if (!(eased > 0)) return std::nullopt;
  return -(1 + e) * u.dot(n) / eased * direction;
}

}  // namespace spook
