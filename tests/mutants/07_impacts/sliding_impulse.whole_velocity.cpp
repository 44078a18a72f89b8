// Wrong: takes the direction of u for that of the slip.
// Killed by: SlidingImpulse.IsOnTheEdgeOfTheConeAgainstTheSlip
// Says: has the largest friction
#include "07_impacts/impacts.hpp"

namespace spook {

std::optional<Vec3> sliding_impulse(const Mat3& K, const Vec3& u, const Vec3& n, double e, double mu) {
  const Vec3 t = u.normalized();
  const Vec3 direction = n - mu * t;
  const double eased = n.dot(K * direction);  // how much approach one N s along `direction` takes away
  if (!(eased > 0)) return std::nullopt;
  return -(1 + e) * u.dot(n) / eased * direction;  // Eq. (7.5)
}

}  // namespace spook
