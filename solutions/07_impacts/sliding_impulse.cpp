#include "07_impacts/impacts.hpp"

namespace spook {

std::optional<Vec3> sliding_impulse(const Mat3& K, const Vec3& u, const Vec3& n, double e, double mu) {
  const Vec3 slip = u - u.dot(n) * n;
  const double speed = slip.norm();
  // A slip of round-off only has a random direction; a NaN stays one.
  const Vec3 t = speed <= 1e-12 * u.norm() ? Vec3(Vec3::Zero()) : Vec3(slip / speed);
  const Vec3 direction = n - mu * t;
  const double eased = n.dot(K * direction);  // the approach that one N s along `direction` removes
  if (!(eased > 0)) return std::nullopt;
  return -(1 + e) * u.dot(n) / eased * direction;  // Eq. (7.5)
}

}  // namespace spook
