// Wrong: slides with a negative denominator.
// Killed by: ImpactImpulse.IsTheSafeImpulseWhereSlidingHasNone
// Says: it pulls
#include "07_impacts/impacts.hpp"

namespace spook {

Vec3 impact_impulse(const Mat3& K, const Vec3& u, const Vec3& n, double e, double mu) {
  if (u.dot(n) >= 0) return Vec3::Zero();
  Vec3 J = stick_impulse(K, u, n, e);
  if (!inside_cone(J, n, mu)) {
    const Vec3 direction = n - mu * (u - u.dot(n) * n).normalized();
    J = -(1 + e) * u.dot(n) / n.dot(K * direction) * direction;
  }
  return J.dot(n) > 0 && impact_work(K, u, J) > 0 ? safe_impulse(K, u, n, e, mu) : J;
}

}  // namespace spook
