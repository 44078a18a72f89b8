// Wrong: compares the two parts without μ.
// Killed by: InsideCone.WidensWithMu
// Says: μ is missing
#include "07_impacts/impacts.hpp"

namespace spook {

bool inside_cone(const Vec3& J, const Vec3& n, double) {
  const double normal = J.dot(n);
  const double tangential = (J - normal * n).norm();
  return normal >= 0 && tangential <= normal;
}

}  // namespace spook
