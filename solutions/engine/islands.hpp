#pragma once
// Islands: rows that feel each other, through bodies that move. What happens on one island has no part in another.
//
//   w       how many rows meet where an island is widest: level by level from one of its ends, those of two neighbouring
//           levels of bodies
//   cost    of factors, in sweeps: (w/5)² at most, as a sweep of n rows takes some 25 n operations, and factors w² n
//   rule    direct where that is at most the sweeps that are allowed; where the masses that rows join differ by more than
//           that number, so that so many sweeps can not suffice, it may cost a hundred times as much
#include <vector>

#include "04_gauss_seidel/gauss_seidel.hpp"

namespace spook {

/// Whether a row acts on a body i, or j, that moves.
template <int Dof>
bool moves_i(const Row<Dof>& row) {
  return !row.MinvGi.isZero(0);
}
template <int Dof>
bool moves_j(const Row<Dof>& row) {
  return !row.MinvGj.isZero(0);
}

/// The rows of each island, in order; islands in the order of their first row. Rows without a body that moves are
/// islands of their own.
template <int Dof>
std::vector<std::vector<int>> islands(const std::vector<Row<Dof>>& rows, std::size_t bodies);

/// w of these rows, which are one island.
template <int Dof>
int width(const std::vector<Row<Dof>>& rows);

/// The largest ratio of two masses that one row joins.
template <int Dof>
double mass_ratio(const std::vector<Row<Dof>>& rows);

/// The rule.
template <int Dof>
bool wants_direct(const std::vector<Row<Dof>>& rows, const StopRule& stop);

}  // namespace spook
