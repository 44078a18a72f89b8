#include "07_impacts/impacts.hpp"
#include "common/not_implemented.hpp"

namespace spook {

bool inside_cone(const Vec3& J, const Vec3& n, double mu) {
  // Eq. (7.4); what goes in and out, and in which units, is in impacts.hpp.
  not_implemented("7.2 inside_cone", J, n, mu);
}

}  // namespace spook
