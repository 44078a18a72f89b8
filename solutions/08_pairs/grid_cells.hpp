#pragma once
// Cells of the grids, one grid for each level of size, Eq. (8.13).
#include <cmath>
#include <cstdint>

#include "08_pairs/pairs.hpp"

namespace spook {

/// The index of a cell along each axis.
using Cell = Eigen::Matrix<std::int64_t, 3, 1>;

/// The level l of a body, with cells of 2^l [m]. Cells are not smaller than the body, which so lies in at most two
/// cells along each axis. Nor are they smaller than the distance of neighbouring doubles there, so a cell's index fits
/// in 53 bits.
int level_of(const Bounds& bounds);

/// The grid of a level.
class Grid {
 public:
  explicit Grid(int level) : level_(level), cells_a_metre_(std::ldexp(1, -level)) {}

  int level() const { return level_; }

  /// Returns the cell that contains a point. Multiplication by a power of two is exact, and so is floor.
  Cell cell_of(const Vec3& x) const { return (cells_a_metre_ * x).array().floor().cast<std::int64_t>(); }

  /// Calls `each` with every cell that a body touches, eight at most. The grid's level must not be below the body's
  /// own.
  template <class Visit>
  void for_each_cell(const Bounds& bounds, const Visit& each) const {
    const Cell first = cell_of(bounds.lower), last = cell_of(bounds.upper);
    for (std::int64_t a = first[0]; a <= last[0]; ++a)
      for (std::int64_t b = first[1]; b <= last[1]; ++b)
        for (std::int64_t c = first[2]; c <= last[2]; ++c) each(Cell(a, b, c));
  }

 private:
  int level_;
  double cells_a_metre_;
};

}  // namespace spook
