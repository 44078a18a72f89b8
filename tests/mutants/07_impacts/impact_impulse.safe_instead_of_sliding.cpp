// Wrong: never slides.
// Killed by: ImpactImpulse.IsThatOfTheNotesWhereItLosesEnergy
// Says: This is the safe impulse
#include "07_impacts/impacts.hpp"

namespace spook {

Vec3 impact_impulse(const Mat3& K, const Vec3& u, const Vec3& n, double e, double mu) {
  if (u.dot(n) >= 0) return Vec3::Zero();
  const Vec3 J = stick_impulse(K, u, n, e);
  return inside_cone(J, n, mu) && impact_work(K, u, J) <= 0 ? J : safe_impulse(K, u, n, e, mu);
}

}  // namespace spook
