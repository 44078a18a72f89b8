// Wrong: has a slack in N s, which is much for a tiny impulse.
// Killed by: InsideCone.HasNoSlack
// Says: |J_t| = 0.8 J_n is more than μ J_n
#include "07_impacts/impacts.hpp"

namespace spook {

bool inside_cone(const Vec3& J, const Vec3& n, double mu) {
  const double normal = J.dot(n);
  const double tangential = (J - normal * n).norm();
  return normal >= 0 &&
         tangential <= mu * normal + 1e-12;  // Eq. (7.4); with mu = 0, 0 <= -0 would let a pull in
}

}  // namespace spook
