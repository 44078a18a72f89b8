// Wrong: does not count the edge.
// Killed by: InsideCone.HasItsEdgeInside
// Says: <= and not <
#include "07_impacts/impacts.hpp"

namespace spook {

bool inside_cone(const Vec3& J, const Vec3& n, double mu) {
  const double normal = J.dot(n);
  const double tangential = (J - normal * n).norm();
  return normal >= 0 && tangential < mu * normal;
}

}  // namespace spook
