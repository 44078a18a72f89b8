#include "07_impacts/impacts.hpp"

namespace spook {

bool inside_cone(const Vec3& J, const Vec3& n, double mu) {
  const double normal = J.dot(n);
  const double tangential = (J - normal * n).norm();
  return tangential <= mu * normal;  // Eq. (7.4); a pull, normal < 0, fails it, too
}

}  // namespace spook
