// Wrong: takes the sphere around the box.
// Killed by: Bounds.HoldEveryCornerAndNoMore
// Says: This holds the sphere
#include "08_pairs/pairs.hpp"

namespace spook {

Bounds bounds(const Box& box) {
  const Vec3 reach = Vec3::Constant(box.half_sides.norm());  // Eq. (8.11)
  return {.lower = box.x - reach, .upper = box.x + reach};
}

}  // namespace spook
