// Wrong: takes the rows of the matrix for the axes.
// Killed by: Bounds.HoldEveryCornerAndNoMore
// Says: these are its rows
#include "08_pairs/pairs.hpp"

namespace spook {

Bounds bounds(const Box& box) {
  const Vec3 reach = box.axes.cwiseAbs().transpose() * box.half_sides;  // Eq. (8.11)
  return {.lower = box.x - reach, .upper = box.x + reach};
}

}  // namespace spook
