#include "06_distance/distance.hpp"
#include "common/not_implemented.hpp"
#include "common/require.hpp"

namespace spook {

Net cloth(const Vec3& corner, const Vec3& u, const Vec3& v, int cells_u, int cells_v, double mass) {
  // Eq. (6.11); what goes in and out, and in which units, is in distance.hpp.
  not_implemented("6.4 cloth", corner, u, v, cells_u, cells_v, mass);
}

}  // namespace spook
