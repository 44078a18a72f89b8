#pragma once
// Other published methods as solvers (engine/solvers/solver.hpp), for comparison only.
//
//   avbd   block descent on bodies, with multipliers and penalties that grow
//   admm   operator splitting: one factorisation, then cheap iterations
//
// SolverResult::row_updates is their cost in row updates: multiply-adds over 4 Dof + 1.
#include "11_direct/direct.hpp"
#include "engine/solvers/registry.hpp"

namespace spook::plots {

/// The cost of a row update in multiply-adds: gather, scatter, and one for λ.
template <int Dof>
constexpr double update_work = 4 * Dof + 1;

/// The cost of factors L D Lᵀ, and of a solve with them, in multiply-adds.
double factor_work(const Factors& factors);
double solve_work(const Factors& factors);

/// Augmented vertex block descent. A history entry belongs to a sweep over the bodies. V holds the velocities of the
/// bodies, which equal M⁻¹ Gᵀ λ only at the end.
template <int Dof>
Solver<Dof> avbd();

/// Alternating direction method of multipliers. A history entry belongs to an iteration.
template <int Dof>
Solver<Dof> admm(FrictionModel model);

}  // namespace spook::plots
