// Wrong: takes u'·n = e u·n.
// Killed by: StickImpulse.OfASphereByHand
// Says: The sign of e
#include <Eigen/Cholesky>

#include "07_impacts/impacts.hpp"

namespace spook {

Vec3 stick_impulse(const Mat3& K, const Vec3& u, const Vec3& n, double e) {
  const Vec3 u_after = e * u.dot(n) * n;
  return K.llt().solve(u_after - u);  // Eq. (7.3)
}

}  // namespace spook
