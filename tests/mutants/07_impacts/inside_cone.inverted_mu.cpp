// Wrong: has μ on the wrong side.
// Killed by: InsideCone.WidensWithMu
// Says: μ is missing, or inverted
#include "07_impacts/impacts.hpp"

namespace spook {

bool inside_cone(const Vec3& J, const Vec3& n, double mu) {
  const double normal = J.dot(n);
  const double tangential = (J - normal * n).norm();
  return normal >= 0 && mu * tangential <= normal;
}

}  // namespace spook
