// Wrong: gives the impulse on body i.
// Killed by: StickImpulse.OfASphereByHand
// Says: the impulse on i
#include <Eigen/Cholesky>

#include "07_impacts/impacts.hpp"

namespace spook {

Vec3 stick_impulse(const Mat3& K, const Vec3& u, const Vec3& n, double e) {
  const Vec3 u_after = -e * u.dot(n) * n;  // Eq. (7.2)
  return K.llt().solve(u - u_after);
}

}  // namespace spook
