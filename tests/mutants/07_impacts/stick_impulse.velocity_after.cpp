// Wrong: takes the velocity after for its change.
// Killed by: StickImpulse.OfASphereByHand
// Says: This is K⁻¹ u'
#include <Eigen/Cholesky>

#include "07_impacts/impacts.hpp"

namespace spook {

Vec3 stick_impulse(const Mat3& K, const Vec3& u, const Vec3& n, double e) {
  const Vec3 u_after = -e * u.dot(n) * n;  // Eq. (7.2)
  return K.llt().solve(u_after);
}

}  // namespace spook
