#pragma once
// The cells of a grid for each level of size, Eq. (8.13).
#include <cmath>
#include <cstdint>

#include "08_pairs/pairs.hpp"

namespace spook {

/// The number of a cell along each axis.
using Cell = Eigen::Matrix<std::int64_t, 3, 1>;

/// The level of a body: cells of 2^l [m] that are not smaller than it, so that it is in two of them along each axis,
/// at most; nor than the distance between neighbouring doubles where it is, so that a cell's number has 53 bits.
int level_of(const Bounds& bounds);

/// The grid of a level.
class Grid {
 public:
  explicit Grid(int level) : level_(level), cells_a_metre_(std::ldexp(1, -level)) {}

  int level() const { return level_; }

  /// The cell in which a point is. Times a power of two is exact, and so is floor.
  Cell cell_of(const Vec3& x) const { return (cells_a_metre_ * x).array().floor().cast<std::int64_t>(); }

  /// Calls `each` with every cell in which a body is, eight at most; the grid's level is not below the body's own.
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
