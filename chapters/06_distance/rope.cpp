#include "06_distance/distance.hpp"
#include "common/not_implemented.hpp"
#include "common/require.hpp"

namespace spook {

Net rope(const Vec3& from, const Vec3& to, int links, double mass) {
  // Eq. (6.10); what goes in and out, and in which units, is in distance.hpp.
  not_implemented("6.3 rope", from, to, links, mass);
}

}  // namespace spook
