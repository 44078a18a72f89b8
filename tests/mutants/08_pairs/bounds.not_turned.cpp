// Wrong: forgets that the box is turned.
// Killed by: Bounds.HoldEveryCornerAndNoMore
// Says: its sides are along e_k
#include "08_pairs/pairs.hpp"

namespace spook {

Bounds bounds(const Box& box) {
  const Vec3 reach = box.half_sides;  // Eq. (8.11)
  return {.lower = box.x - reach, .upper = box.x + reach};
}

}  // namespace spook
