#pragma once
// The solvers, one file each in this room, all with the signature of Solver.
//
//   on their own     gauss_seidel, ordered_gauss_seidel, cone_gauss_seidel, spatial_decomposition, colours, blocks,
//                    conjugate_gradients, anderson, newton, direct, automatic
//   with another     two_pass(solver), geometric_stiffness(solver): the outer one says which rows there are and what
//                    bounds they have, and the inner one solves them
//
//   two_pass(direct<6>())                                       friction limited by normal forces that are exact
//   two_pass(ordered_gauss_seidel<3>(RowOrder::random, 1))      by those of sweeps in a random order
//   geometric_stiffness(automatic<3>())                         for links that swing freely
//
// Cones and orders are sweeps themselves, and take no other solver.
#include <cstdint>
#include <string>
#include <vector>

#include "engine/solvers/solver.hpp"

namespace spook {

/// Projected Gauss-Seidel, chapter 04's.
template <int Dof>
Solver<Dof> gauss_seidel();

/// Chapter 10's.
template <int Dof>
Solver<Dof> conjugate_gradients();

/// Sweeps of chapter 04, or on cones, accelerated. The model is box or cone.
template <int Dof>
Solver<Dof> anderson(FrictionModel model = FrictionModel::box);

/// Newton's method on the cone or the box, by factors on bodies; accelerated sweeps where it does not help.
template <int Dof>
Solver<Dof> newton(FrictionModel model = FrictionModel::box);

/// Chapter 11's; keeps its factors for the next step.
template <int Dof>
Solver<Dof> direct();

/// Each island of bodies by factors or by sweeps, by the rule of engine/solvers/islands.hpp. The model is box or cone.
template <int Dof>
Solver<Dof> automatic(FrictionModel model = FrictionModel::cone);

/// Projected Gauss-Seidel in stripes of space, on as many threads as it may use.
template <int Dof>
Solver<Dof> spatial_decomposition();

/// Sweeps by colours in lanes, chapter 14's. The model is box or cone.
template <int Dof>
Solver<Dof> colours(FrictionModel model = FrictionModel::box);

/// Gauss-Seidel on cones, each contact with its friction as a block, chapter 14's.
template <int Dof>
Solver<Dof> blocks();

/// In which order the sweeps go through the rows.
enum class RowOrder {
  given,   ///< as they come
  up,      ///< by the height of what a row acts on, against gravity: Eq. (10.3)
  down,    ///< along it
  random,  ///< another one in every solve: Eq. (10.4)
  /// The rows of the first half and of the second in turn: two that follow each other seldom share a body, so that one
  /// update need not wait for the other.
  interleaved
};

/// Projected Gauss-Seidel in that order. A copy goes on with the same random orders.
template <int Dof>
Solver<Dof> ordered_gauss_seidel(RowOrder order, std::uint64_t seed = 1);

/// 0, m, 1, m + 1, ... of n rows, with m their half, rounded up: Eq. (14.13).
std::vector<int> interleaved_order(std::size_t n);

/// Sweeps in that order, which has every row once, by the rule of chapter 04's solve.
template <int Dof>
SolveReport solve_in_order(const std::vector<int>& order, std::vector<Row<Dof>>& rows,
                           std::vector<Twist<Dof>>& V, const StopRule& stop);

/// Sweeps on Coulomb's cones, chapter 09's.
template <int Dof>
Solver<Dof> cone_gauss_seidel();

/// Friction limited by the normal impulses of a first pass: chapter 09's two passes, with `inner` for both.
/// Throws std::invalid_argument for an inner solver that is null, or has limits of its own.
template <int Dof>
Solver<Dof> two_pass(Solver<Dof> inner);

/// Chapter 12's, for the links of point masses that no contact has to do with; `inner` for all other rows.
/// Throws std::invalid_argument for rigid bodies, and for an inner solver that is null.
template <int Dof>
Solver<Dof> geometric_stiffness(Solver<Dof> inner);

/// A solver as it is asked for.
template <int Dof>
struct NamedSolver {
  std::string name;
  std::string summary;
  std::string iteration;  ///< what an entry of its history is of, one of them
  /// Makes the solver, with nothing kept yet; throws std::invalid_argument where it is not for such bodies.
  Solver<Dof> (*make)();
  /// The same with friction on Coulomb's cones; null where it cannot.
  Solver<Dof> (*make_on_cones)();
};

/// All there are; the first is the default. The names do not depend on Dof.
template <int Dof>
const std::vector<NamedSolver<Dof>>& solvers();

/// Throws std::invalid_argument, with the nearest name there is, for a name that is not one of them.
template <int Dof>
const NamedSolver<Dof>& find_solver(const std::string& name);

}  // namespace spook
