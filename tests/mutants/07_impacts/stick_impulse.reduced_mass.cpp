// Wrong: takes the mass along the normal for all directions.
// Killed by: StickImpulse.LeavesTheRestitutionAndNoSlip
// Says: Every number of K counts
#include "07_impacts/impacts.hpp"

namespace spook {

Vec3 stick_impulse(const Mat3& K, const Vec3& u, const Vec3& n, double e) {
  const Vec3 u_after = -e * u.dot(n) * n;  // Eq. (7.2)
  return (u_after - u) / n.dot(K * n);
}

}  // namespace spook
