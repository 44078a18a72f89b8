// Wrong: asks whether it is not outside.
// Killed by: InsideCone.HasNoNaNInside
// Says: Every comparison with NaN is false
#include "07_impacts/impacts.hpp"

namespace spook {

bool inside_cone(const Vec3& J, const Vec3& n, double mu) {
  const double normal = J.dot(n);
  const double tangential = (J - normal * n).norm();
  return !(normal < 0 || tangential > mu * normal);
}

}  // namespace spook
