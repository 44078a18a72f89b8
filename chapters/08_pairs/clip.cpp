#include "08_pairs/pairs.hpp"
#include "common/not_implemented.hpp"

namespace spook {

std::vector<Vec3> clip(const std::vector<Vec3>& polygon, const Vec3& n, double offset) {
  // Eq. (8.8); what goes in and out, and in which units, is in pairs.hpp.
  not_implemented("8.6 clip", polygon, n, offset);
}

}  // namespace spook
