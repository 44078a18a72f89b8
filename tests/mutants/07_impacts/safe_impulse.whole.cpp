// Wrong: has κ = 1 always.
// Killed by: SafeImpulse.OfASphereByHand
// Says: which leaves the cone
#include <Eigen/Cholesky>

#include "07_impacts/impacts.hpp"

namespace spook {

Vec3 safe_impulse(const Mat3& K, const Vec3& u, const Vec3& n, double e, double) {
  const double p = -u.dot(n) / n.dot(K * n);
  const Vec3 P = p * n;                     // stops the approach, without friction
  const Vec3 more = K.llt().solve(-u) - P;  // Q - P: what it takes to stop the slip, too
  return (1 + e) * P + more;
}

}  // namespace spook
