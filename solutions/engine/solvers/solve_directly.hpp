#pragma once
// Solves rows by factors, with rows or bodies as unknowns, whichever are fewer.
//
//   on rows     S λ = B, Eq. (11.1), (11.3), interior point, Eq. (11.5)-(11.14): direct_solve of chapter 11
//   on bodies   Eq. (11.15), from the current λ: engine/solvers/primal_newton.hpp; on rows if that does not converge
#include "engine/solvers/primal_newton.hpp"

namespace spook {

/// Caches of both methods for the next step: orders of elimination and patterns.
template <int Dof>
struct RowAndVelocityFactors {
  Factors on_rows;
  PrimalFactors<Dof> on_bodies;
};

/// Solves the rows within their bounds. On entry V is M⁻¹ Gᵀ λ, with each λ within its bounds; `inverse_mass` and V
/// have one entry per body. Each history entry belongs to a factorisation, of which each method makes at most
/// stop.max_sweeps. If neither method converges, sweeps continue from there, and `trouble` gives the reason.
template <int Dof>
SolveReport solve_directly(std::vector<Row<Dof>>& rows, const std::vector<InverseMass<Dof>>& inverse_mass,
                           std::vector<Twist<Dof>>& V, const StopRule& stop,
                           RowAndVelocityFactors<Dof>& factors);

/// Sets each λ to its entry of `impulses`, clamped to its bounds, and V to M⁻¹ Gᵀ λ. An empty list stands for zeros.
template <int Dof>
void start_from(const std::vector<double>& impulses, std::vector<Row<Dof>>& rows, std::vector<Twist<Dof>>& V);

}  // namespace spook
