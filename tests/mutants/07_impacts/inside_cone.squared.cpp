// Wrong: squares both sides, and so does not see a pull.
// Killed by: InsideCone.HasNoPullInside
// Says: A squared comparison
#include "07_impacts/impacts.hpp"

namespace spook {

bool inside_cone(const Vec3& J, const Vec3& n, double mu) {
  const double normal = J.dot(n);
  const double tangential = (J - normal * n).norm();
  return tangential * tangential <= mu * mu * normal * normal;
}

}  // namespace spook
