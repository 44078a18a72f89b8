// Wrong: multiplies by K instead of solving with it.
// Killed by: StickImpulse.OfASphereByHand
// Says: This is K (u' - u)
#include "07_impacts/impacts.hpp"

namespace spook {

Vec3 stick_impulse(const Mat3& K, const Vec3& u, const Vec3& n, double e) {
  const Vec3 u_after = -e * u.dot(n) * n;  // Eq. (7.2)
  return K * (u_after - u);
}

}  // namespace spook
