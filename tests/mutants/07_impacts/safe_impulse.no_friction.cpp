// Wrong: has κ = 0 always.
// Killed by: SafeImpulse.OfASphereByHand
// Says: This is κ = 0
#include "07_impacts/impacts.hpp"

namespace spook {

Vec3 safe_impulse(const Mat3& K, const Vec3& u, const Vec3& n, double e, double) {
  const Vec3 P = -u.dot(n) / n.dot(K * n) * n;
  return (1 + e) * P;
}

}  // namespace spook
