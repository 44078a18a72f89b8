// Wrong: resolves bodies that part.
// Killed by: ImpactImpulse.LeavesBodiesThatPartAlone
// Says: it is an impact only if u·n < 0
#include "07_impacts/impacts.hpp"

namespace spook {

Vec3 impact_impulse(const Mat3& K, const Vec3& u, const Vec3& n, double e, double mu) {
  std::optional<Vec3> J = stick_impulse(K, u, n, e);
  if (!inside_cone(*J, n, mu)) J = sliding_impulse(K, u, n, e, mu);
  if (!J || impact_work(K, u, *J) > 0) return safe_impulse(K, u, n, e, mu);
  return *J;
}

}  // namespace spook
