// Wrong: takes a pull for a push.
// Killed by: InsideCone.HasNoPullInside
// Says: A squared comparison, or |J·n|
#include <cmath>

#include "07_impacts/impacts.hpp"

namespace spook {

bool inside_cone(const Vec3& J, const Vec3& n, double mu) {
  const double normal = J.dot(n);
  const double tangential = (J - normal * n).norm();
  return tangential <= mu * std::abs(normal);
}

}  // namespace spook
