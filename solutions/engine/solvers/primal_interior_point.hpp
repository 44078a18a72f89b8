#pragma once
// Chapter 11's interior-point method, Eq. (11.5)-(11.13), with the velocities of bodies as unknowns of S̃ Δλ = r.
//
//   softness     Σ̃ = Σ + z⁻/s⁻ + z⁺/s⁺ on the diagonal: the multipliers of bounds add to Σ        Eq. (11.7)
//   velocities   (M + Gᵀ Σ̃⁻¹ G) v = Gᵀ Σ̃⁻¹ r,  Δλ = Σ̃⁻¹ (r - G v)                                Eq. (11.15)
//
// Robust to many rows reaching bounds together. Always takes twenty to forty factorisations.
#include "engine/linear/velocity_factors.hpp"
#include "engine/linear/velocity_system.hpp"
#include "engine/solvers/solver_result.hpp"

namespace spook {

/// Solves the rows within their bounds; updates their λ, and V. The initial λ give the order of magnitude of the
/// impulses. All rows must have Σ > 0. The history has the residual of Eq. (4.8) after each factorisation. The report
/// has not converged if stop.max_sweeps factorisations do not suffice, or if a pivot fails Eq. (11.4).
template <int Dof>
SolveReport primal_interior_point(std::vector<Row<Dof>>& rows, VelocitySystem<Dof>& velocity_system,
                                  std::vector<Twist<Dof>>& V, const StopRule& stop, VelocityFactors& factors);

}  // namespace spook
