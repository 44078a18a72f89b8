#include "07_impacts/impacts.hpp"
#include "common/not_implemented.hpp"

namespace spook {

double impact_work(const Mat3& K, const Vec3& u, const Vec3& J) {
  // Eq. (7.6); what goes in and out, and in which units, is in impacts.hpp.
  not_implemented("7.4 impact_work", K, u, J);
}

}  // namespace spook
