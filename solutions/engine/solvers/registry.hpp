#pragma once
// The solvers: one file each in this room, all with the signature of Solver.
//
//   complete     gauss_seidel, ordered_gauss_seidel, cone_gauss_seidel, spatial_decomposition, colours, blocks,
//                conjugate_gradients, anderson, newton, direct, automatic
//   composed     two_pass(solver), geometric_stiffness(solver): the outer solver selects rows and bounds, and the inner
//                solver solves them
//
//   two_pass(direct<6>())                                       friction limited by exact normal forces
//   two_pass(ordered_gauss_seidel<3>(RowOrder::random, 1))      friction limited by normal forces of random sweeps
//   geometric_stiffness(automatic<3>())                         for links that swing freely
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "engine/solvers/row_order.hpp"
#include "engine/solvers/solver.hpp"

namespace spook {

/// Projected Gauss-Seidel of chapter 04.
template <int Dof>
Solver<Dof> gauss_seidel();

/// Projected conjugate gradients of chapter 10.
template <int Dof>
Solver<Dof> conjugate_gradients();

/// Sweeps of chapter 04 or on cones, with Anderson acceleration. The model is box or cone.
template <int Dof>
Solver<Dof> anderson(FrictionModel model = FrictionModel::cone);

/// Newton's method on the box or cone, with factors over bodies. Falls back to accelerated sweeps if it stalls.
template <int Dof>
Solver<Dof> newton(FrictionModel model = FrictionModel::cone);

/// The direct solver of chapter 11; keeps its factors for the next step.
template <int Dof>
Solver<Dof> direct();

/// Selects factors or sweeps for each island of bodies: engine/solvers/automatic.cpp. The model is box or cone.
/// `accuracy` is the residual at which a solve ends, as a share of the right-hand side, in (0, 1); below 1e-6 not every
/// step reaches it. Default: 1e-6, and 3e-3 of the largest approach for contacts of moving bodies.
template <int Dof>
Solver<Dof> automatic(FrictionModel model = FrictionModel::cone, std::optional<double> accuracy = {});

/// Projected Gauss-Seidel in stripes of space, on the threads of the settings.
template <int Dof>
Solver<Dof> spatial_decomposition();

/// Sweeps by colours in lanes, as in chapter 14. `model` is box or cone.
template <int Dof>
Solver<Dof> colours(FrictionModel model = FrictionModel::cone);

/// Gauss-Seidel on cones, with each contact and its friction as a block, as in chapter 14.
template <int Dof>
Solver<Dof> blocks();

/// Projected Gauss-Seidel in that order. A copy continues with the same random orders.
template <int Dof>
Solver<Dof> ordered_gauss_seidel(RowOrder order, std::uint64_t seed = 1);

/// Sweeps on Coulomb's cones of chapter 09.
template <int Dof>
Solver<Dof> cone_gauss_seidel();

/// Two passes of chapter 09: the normal impulses of a first pass limit friction in the second; `inner` solves both.
/// Throws std::invalid_argument if `inner` is null, or has a friction model other than the box.
template <int Dof>
Solver<Dof> two_pass(Solver<Dof> inner);

/// The method of chapter 12 for links of point masses on islands without contacts; `inner` solves all other rows.
/// Throws std::invalid_argument for rigid bodies, and if `inner` is null.
template <int Dof>
Solver<Dof> geometric_stiffness(Solver<Dof> inner);

/// An entry of the registry.
template <int Dof>
struct NamedSolver {
  std::string name;
  std::string summary;
  std::string iteration;  ///< name of one iteration, to which a history entry belongs
  /// Creates the solver with empty caches, and with friction on the box. Throws std::invalid_argument if the solver
  /// does not support such bodies.
  Solver<Dof> (*make_on_box)();
  /// Creates the solver with friction on Coulomb's cones; null if it has no such version.
  Solver<Dof> (*make_on_cones)();
  bool takes_row_order = false;  ///< ordered_gauss_seidel is this solver in another order
  /// Creates the solver with an accuracy, as automatic() has it; null if it has none.
  Solver<Dof> (*make_to)(FrictionModel model, double accuracy) = nullptr;
};

/// The solvers that have a name; two_pass and ordered_gauss_seidel are functions only. The default of a world is
/// automatic(), "auto". The names do not depend on Dof.
template <int Dof>
const std::vector<NamedSolver<Dof>>& solvers();

/// Returns the solver of that name. Throws std::invalid_argument, with the nearest known name, for an unknown name.
template <int Dof>
const NamedSolver<Dof>& find_solver(const std::string& name);

}  // namespace spook
