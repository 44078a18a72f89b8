#include "08_pairs/touching_bounds.hpp"

#include "common/require.hpp"

namespace spook {

void require_sound(const std::vector<Bounds>& bounds) {
  for (const Bounds& one : bounds) {
    if (!one.lower.allFinite()) require_all_finite("lower", one.lower);
    if (!one.upper.allFinite()) require_all_finite("upper", one.upper);
    for (int k = 0; k < 3; ++k)
      if (one.upper[k] < one.lower[k]) reject("upper", one.upper[k], "at or above its lower");
  }
}

}  // namespace spook
