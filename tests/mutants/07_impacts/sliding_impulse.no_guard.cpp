// Wrong: divides by whatever it gets.
// Killed by: SlidingImpulse.DoesNotExistWhereFrictionWins
// Says: With a negative denominator J would pull
#include "07_impacts/impacts.hpp"

namespace spook {

std::optional<Vec3> sliding_impulse(const Mat3& K, const Vec3& u, const Vec3& n, double e, double mu) {
  const Vec3 slip = u - u.dot(n) * n;
  const double speed = slip.norm();
  const Vec3 t = speed == 0 ? Vec3(Vec3::Zero()) : Vec3(slip / speed);
  const Vec3 direction = n - mu * t;
  const double eased = n.dot(K * direction);       // how much approach one N s along `direction` takes away
  return -(1 + e) * u.dot(n) / eased * direction;  // Eq. (7.5)
}

}  // namespace spook
