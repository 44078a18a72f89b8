// Wrong: lets a pull straight along n in where μ = 0.
// Killed by: InsideCone.HasNoPullInside
// Says: 0 <= -0 is true
#include "07_impacts/impacts.hpp"

namespace spook {

bool inside_cone(const Vec3& J, const Vec3& n, double mu) {
  const double normal = J.dot(n);
  const double tangential = (J - normal * n).norm();
  return tangential <= mu * normal;
}

}  // namespace spook
