// Wrong: does not divide the slip by its length.
// Killed by: SlidingImpulse.OfASphereByHand
// Says: t is a direction
#include "07_impacts/impacts.hpp"

namespace spook {

std::optional<Vec3> sliding_impulse(const Mat3& K, const Vec3& u, const Vec3& n, double e, double mu) {
  const Vec3 slip = u - u.dot(n) * n;
  const Vec3 t = slip;
  const Vec3 direction = n - mu * t;
  const double eased = n.dot(K * direction);  // how much approach one N s along `direction` takes away
  if (!(eased > 0)) return std::nullopt;
  return -(1 + e) * u.dot(n) / eased * direction;  // Eq. (7.5)
}

}  // namespace spook
