// Wrong: lets sliding add energy.
// Killed by: ImpactImpulse.DoesNotLetSlidingAddEnergy
// Says: This slides, and adds 0.18 J/kg
#include "07_impacts/impacts.hpp"

namespace spook {

Vec3 impact_impulse(const Mat3& K, const Vec3& u, const Vec3& n, double e, double mu) {
  if (u.dot(n) >= 0) return Vec3::Zero();
  const Vec3 stick = stick_impulse(K, u, n, e);
  if (inside_cone(stick, n, mu)) return impact_work(K, u, stick) > 0 ? safe_impulse(K, u, n, e, mu) : stick;
  const std::optional<Vec3> J = sliding_impulse(K, u, n, e, mu);
  return J ? *J : safe_impulse(K, u, n, e, mu);
}

}  // namespace spook
