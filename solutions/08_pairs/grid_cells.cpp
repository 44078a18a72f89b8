#include "08_pairs/grid_cells.hpp"

#include <algorithm>
#include <cmath>

namespace spook {

static constexpr int finest_level = -1000;  // 2^1000 is still a double

/// Returns the smallest l with x <= 2^l.
static int exponent(double x) {
  int power;
  return std::frexp(x, &power) == 0.5 ? power - 1 : power;
}

int level_of(const Bounds& bounds) {
  const double half_size = (bounds.upper / 2 - bounds.lower / 2).maxCoeff();  // halves don't overflow
  const double farthest = bounds.lower.cwiseAbs().cwiseMax(bounds.upper.cwiseAbs()).maxCoeff();
  int level = farthest == 0 ? finest_level : std::max(finest_level, std::ilogb(farthest) - 52);
  if (half_size > 0) level = std::max(level, exponent(half_size) + 1);
  // The size is rounded: it may exceed 2^l by less than the round-off.
  const auto too_many = [&](const Grid& grid) {
    return ((grid.cell_of(bounds.upper) - grid.cell_of(bounds.lower)).array() > 1).any();
  };
  while (too_many(Grid(level))) ++level;
  return level;
}

}  // namespace spook
