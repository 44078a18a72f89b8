// Wrong: allows a millionth of a joule, which is much for a light body.
// Killed by: ImpactImpulse.DoesNotLetStickingAddEnergy
// Says: This sticks, and adds 0.11 J/kg
#include "07_impacts/impacts.hpp"

namespace spook {

Vec3 impact_impulse(const Mat3& K, const Vec3& u, const Vec3& n, double e, double mu) {
  if (u.dot(n) >= 0) return Vec3::Zero();
  std::optional<Vec3> J = stick_impulse(K, u, n, e);
  if (!inside_cone(*J, n, mu)) J = sliding_impulse(K, u, n, e, mu);
  if (!J || impact_work(K, u, *J) > 1e-6) return safe_impulse(K, u, n, e, mu);
  return *J;
}

}  // namespace spook
