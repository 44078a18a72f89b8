#pragma once
// Methods that people ask about, as solvers of a step's rows (engine/solvers/solver.hpp): to be compared, not to be used.
//
//   avbd   block descent on bodies, with multipliers and penalties that grow
//   admm   operator splitting: one factorisation, then cheap iterations
//
// SolverResult::row_updates is what they cost, in updates of a row: multiply-adds over 4 Dof + 1.
#include "11_direct/direct.hpp"
#include "engine/solvers/registry.hpp"

namespace spook::plots {

/// What an update of a row costs, in multiply-adds: gather, scatter, and one for λ.
template <int Dof>
constexpr double update_work = 4 * Dof + 1;

/// The same of factors L D Lᵀ, and of a solve with them.
double factor_work(const Factors& factors);
double solve_work(const Factors& factors);

/// Augmented vertex block descent. One entry of its history is of a sweep over the bodies. V is what the bodies have, which
/// is M⁻¹ Gᵀ λ in the end only.
template <int Dof>
Solver<Dof> avbd();

/// Alternating direction method of multipliers. One entry of its history is of an iteration.
template <int Dof>
Solver<Dof> admm(FrictionModel model);

}  // namespace spook::plots
