// Wrong: compares the whole impulse.
// Killed by: InsideCone.WidensWithMu
// Says: compare the tangential part
#include "07_impacts/impacts.hpp"

namespace spook {

bool inside_cone(const Vec3& J, const Vec3& n, double mu) {
  const double normal = J.dot(n);
  return normal >= 0 && J.norm() <= mu * normal;
}

}  // namespace spook
