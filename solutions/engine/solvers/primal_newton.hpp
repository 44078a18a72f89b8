#pragma once
// Solving a step on its bodies: where many rows meet on few bodies there are fewer velocities than impulses.
//
//   free rows       G V + Σ λ = B, so that λ = Σ⁻¹ (B - G V)
//   velocities      (M + Gᵀ Σ⁻¹ G) V = Gᵀ Σ⁻¹ B + Gᵀ λ_bound                                          Eq. (11.15)
//   bounds          rows at a bound are held there, and those that an update, Eq. (4.7), would take to one; the others are
//                   free, and solved; then as far that way as ½ λᵀ S λ - Bᵀ λ falls, clamped; then a few sweeps
//   from within     where that gets nowhere, since many rows with friction hold the same few bodies and it hardly matters
//                   which of them slide: engine/solvers/primal_interior_point.hpp
//   roundings       Σ⁻¹ is large, and λ a small difference: what its rows still lack is solved for in the same way, a few
//                   times, Eq. (11.14)
//
// An unchanged active set takes one factorisation. Two bodies that touch at four points with friction are twelve rows
// and a block of 6 x 6.
#include <optional>

#include "11_direct/direct.hpp"
#include "engine/linear/velocity_factors.hpp"
#include "engine/linear/velocity_system.hpp"
#include "engine/solvers/solver.hpp"

namespace spook {

/// What the next step most often has again: who shares rows with whom, and the order and the pattern of the factors.
template <int Dof>
struct PrimalFactors {
  VelocitySystem<Dof> on;
  VelocityFactors factors;
};

/// Solves the rows within their bounds, from the λ that they have, which is within them, and its V. Nothing, and rows
/// and V as they were, where Σ is 0 in a row, a pivot is not sound, or stop.max_sweeps factorisations of either kind do not suffice.
/// The history has the residual of Eq. (4.8) after each factorisation.
template <int Dof>
std::optional<SolveReport> primal_newton(std::vector<Row<Dof>>& rows,
                                         const std::vector<InverseMass<Dof>>& inverse_mass,
                                         std::vector<Twist<Dof>>& V, const StopRule& stop,
                                         PrimalFactors<Dof>& kept);

}  // namespace spook
