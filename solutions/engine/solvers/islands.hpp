#pragma once
// Islands: rows that feel each other, through bodies that move. What happens on one island has no part in another.
//
//   w      how many unknowns meet where an island is widest: level by level from one of its ends, those of two
//          neighbouring levels of bodies. Unknowns are its n rows, or the velocities of its bodies, if those are fewer
//   cost   of factors, in sweeps: w²/25 at most on rows, as a sweep of n rows takes some 25 n operations, and factors w² n
#include <cstddef>
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

/// Whether velocities are the cheaper unknowns: fewer than the rows with bounds, than half of those without.
template <int Dof>
bool wants_bodies(const std::vector<Row<Dof>>& rows);

/// What factors of these rows, which are one island, cost at most, in sweeps of them.
template <int Dof>
double factor_cost(const std::vector<Row<Dof>>& rows);

/// The same with the velocities of bodies as unknowns.
template <int Dof>
double velocity_factor_cost(const std::vector<Row<Dof>>& rows);

}  // namespace spook
