#pragma once
// Islands: groups of rows that are coupled through dynamic bodies. Islands are independent of each other.
//
//   w      width of an island: the largest number of unknowns in two neighbouring levels of bodies, counted from one
//          end. Unknowns are the n rows, or the velocities of the bodies if those are fewer
//   cost   of factors, in sweeps: at most w²/25 on rows, since a sweep of n rows takes about 25 n operations, and
//          factors take w² n
#include <cstddef>
#include <vector>

#include "04_gauss_seidel/gauss_seidel.hpp"

namespace spook {

/// Tells whether body i, or j, of a row is dynamic: whether the row's impulse changes its velocity. Needs no masses,
/// unlike is_dynamic of engine/linear/body_numbers.hpp.
template <int Dof>
bool moves_i(const Row<Dof>& row) {
  return !row.MinvGi.isZero(0);
}
template <int Dof>
bool moves_j(const Row<Dof>& row) {
  return !row.MinvGj.isZero(0);
}

/// The rows of each island, in order; islands are in the order of their first row. A row without a dynamic body is an
/// island of its own.
template <int Dof>
std::vector<std::vector<int>> islands(const std::vector<Row<Dof>>& rows, std::size_t bodies);

/// Tells whether velocities are the cheaper unknowns: fewer than the rows with bounds and half of the rows without
/// bounds together.
template <int Dof>
bool wants_bodies(const std::vector<Row<Dof>>& rows);

/// An upper bound of the cost of factors of one island, in sweeps of its rows. The width of the island gives one bound.
/// If it exceeds `affordable`, the multiplications are counted, in the order of engine/linear/elimination.hpp: a grid is
/// wide, and yet its factors are cheap. Islands with a bounded row are not counted, since they take many factors, nor are
/// those in which the rows on one body alone cost more than is affordable.
template <int Dof>
double factor_cost(const std::vector<Row<Dof>>& rows, double affordable = infinity);

/// An upper bound of the cost of factors with the velocities of bodies as unknowns, in sweeps of the rows.
template <int Dof>
double velocity_factor_cost(const std::vector<Row<Dof>>& rows);

/// The same cost, with multiplications counted in the order of engine/linear/elimination.hpp. In pyramids and heaps it is
/// a tenth of the bound or less, but counting takes as long as some sweeps.
template <int Dof>
double counted_velocity_factor_cost(const std::vector<Row<Dof>>& rows);

}  // namespace spook
