// Wrong: takes the reach of one corner.
// Killed by: Bounds.HoldEveryCornerAndNoMore
// Says: The absolute value of one corner
#include "08_pairs/pairs.hpp"

namespace spook {

Bounds bounds(const Box& box) {
  const Vec3 reach = (box.axes * box.half_sides).cwiseAbs();  // Eq. (8.11)
  return {.lower = box.x - reach, .upper = box.x + reach};
}

}  // namespace spook
