// Wrong: lets what is just outside in.
// Killed by: InsideCone.HasNoSlack
// Says: 1e-12 of it more than μ J_n here
#include "07_impacts/impacts.hpp"

namespace spook {

bool inside_cone(const Vec3& J, const Vec3& n, double mu) {
  const double normal = J.dot(n);
  const double tangential = (J - normal * n).norm();
  return normal >= 0 &&
         tangential <= mu * normal * (1 + 1e-6);  // Eq. (7.4); with mu = 0, 0 <= -0 would let a pull in
}

}  // namespace spook
