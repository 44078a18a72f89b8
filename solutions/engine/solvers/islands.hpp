#pragma once
// Islands: groups of rows that are coupled through dynamic bodies. Islands are independent of each other.
#include <cmath>
#include <cstddef>
#include <vector>

#include "engine/linear/body_numbers.hpp"

namespace spook {

/// Tells whether the row has a bound.
template <int Dof>
bool is_bounded(const Row<Dof>& row) {
  return std::isfinite(row.lo) || std::isfinite(row.hi);
}

/// The rows of each island, in order; islands are in the order of their first row. A row without a dynamic body is an
/// island of its own.
template <int Dof>
std::vector<std::vector<int>> islands(const std::vector<Row<Dof>>& rows, std::size_t bodies);

}  // namespace spook
