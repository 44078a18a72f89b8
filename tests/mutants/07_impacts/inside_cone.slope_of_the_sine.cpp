// Wrong: compares with the whole impulse.
// Killed by: InsideCone.WidensWithMu
// Says: compare with the normal part
#include "07_impacts/impacts.hpp"

namespace spook {

bool inside_cone(const Vec3& J, const Vec3& n, double mu) {
  const double normal = J.dot(n);
  const double tangential = (J - normal * n).norm();
  return normal >= 0 && tangential <= mu * J.norm();
}

}  // namespace spook
