#pragma once
// Bounds met from within, on bodies: chapter 11's interior point method, Eq. (11.5)-(11.13), whose S̃ Δλ = r is solved by
// the velocities.
//
//   softness     Σ̃ = Σ + z⁻/s⁻ + z⁺/s⁺, on the diagonal: what a bound pushes back with makes a row softer     Eq. (11.7)
//   velocities   (M + Gᵀ Σ̃⁻¹ G) v = Gᵀ Σ̃⁻¹ r,  Δλ = Σ̃⁻¹ (r - G v)                                            Eq. (11.15)
//
// Robust to many rows reaching bounds together; always takes some twenty to forty factorisations.
#include "engine/linear/velocity_factors.hpp"
#include "engine/linear/velocity_system.hpp"
#include "engine/solvers/solver_result.hpp"

namespace spook {

/// Solves the rows within their bounds: λ into the rows, V into `V`. The λ that they have tell how large impulses are. All
/// have Σ > 0. The history has the residual of Eq. (4.8) after each factorisation, of which there are at most
/// stop.max_sweeps; not converged where they do not suffice, or a pivot is not sound.
template <int Dof>
SolveReport primal_interior_point(std::vector<Row<Dof>>& rows, VelocitySystem<Dof>& on,
                                  std::vector<Twist<Dof>>& V, const StopRule& stop, VelocityFactors& factors);

}  // namespace spook
