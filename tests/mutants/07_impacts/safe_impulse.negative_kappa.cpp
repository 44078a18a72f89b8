// Wrong: divides by a negative number where J never leaves the cone.
// Killed by: SafeImpulse.OfARodByHand
// Says: Divide only by what is positive
#include <Eigen/Cholesky>
#include <algorithm>

#include "07_impacts/impacts.hpp"

namespace spook {

Vec3 safe_impulse(const Mat3& K, const Vec3& u, const Vec3& n, double e, double mu) {
  const double p = -u.dot(n) / n.dot(K * n);
  const Vec3 P = p * n;                     // stops the approach, without friction
  const Vec3 more = K.llt().solve(-u) - P;  // Q - P: what it takes to stop the slip, too

  // |J_t| = κ |more_t| and J_n = (1+e) p + κ more_n: inside the cone up to     Eq. (7.8)
  const double more_n = more.dot(n);
  const double leaves = (more - more_n * n).norm() - mu * more_n;
  const double kappa = std::min(1.0, mu * (1 + e) * p / leaves);
  return (1 + e) * P + kappa * more;  // Eq. (7.7)
}

}  // namespace spook
