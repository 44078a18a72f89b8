// Wrong: takes |D| for |D_t|.
// Killed by: SafeImpulse.IsTheLargestInsideTheCone
// Says: found with |D| for |D_t|
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
  const double leaves = more.norm() - mu * more_n;
  const double kappa = leaves > 0 ? std::min(1.0, mu * (1 + e) * p / leaves) : 1;
  return (1 + e) * P + kappa * more;  // Eq. (7.7)
}

}  // namespace spook
