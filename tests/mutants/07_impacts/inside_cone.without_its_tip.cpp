// Wrong: takes no impulse at all for a pull.
// Killed by: InsideCone.HasItsEdgeInside
// Says: J = 0 is the tip of the cone
#include "07_impacts/impacts.hpp"

namespace spook {

bool inside_cone(const Vec3& J, const Vec3& n, double mu) {
  const double normal = J.dot(n);
  return normal > 0 && (J - normal * n).norm() <= mu * normal;
}

}  // namespace spook
