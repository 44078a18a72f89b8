#pragma once
// The cost of factors of an island, before they are made.
//
//   w      width of an island: the largest number of unknowns in two neighbouring levels of bodies, counted from one
//          end. Unknowns are the n rows, or the velocities of the bodies if those are fewer
//   cost   in sweeps: at most w²/25 on rows, since a sweep of n rows takes about 25 n operations, and factors take w² n
#include <vector>

#include "04_gauss_seidel/gauss_seidel.hpp"

namespace spook {

/// Tells whether velocities are the cheaper unknowns: fewer than the rows with bounds and half of the rows without
/// bounds together.
template <int Dof>
bool wants_bodies(const std::vector<Row<Dof>>& rows);

/// An upper bound of the cost of factors of one island, in sweeps of its rows. The width of the island gives one bound.
/// If it exceeds `affordable`, the multiplications are counted, in the order of engine/linear/elimination.hpp: a grid
/// is wide, and yet its factors are cheap. Islands with a bounded row are not counted, since they take many factors,
/// nor are those in which the rows on one body alone cost more than is affordable.
template <int Dof>
double factor_cost(const std::vector<Row<Dof>>& rows, double affordable = infinity);

/// An upper bound of the cost of factors with the velocities of bodies as unknowns, in sweeps of the rows.
template <int Dof>
double velocity_factor_cost(const std::vector<Row<Dof>>& rows);

/// The same cost, with multiplications counted in the order of engine/linear/elimination.hpp. In pyramids and heaps it
/// is a tenth of the bound or less, but counting takes as long as some sweeps.
template <int Dof>
double counted_velocity_factor_cost(const std::vector<Row<Dof>>& rows);

}  // namespace spook
