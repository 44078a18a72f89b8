#pragma once
// Active-set method with velocities of bodies as unknowns: many rows on few bodies have fewer velocities than impulses.
//
//   free rows        G V + Σ λ = B, so that λ = Σ⁻¹ (B - G V)
//   velocities       (M + Gᵀ Σ⁻¹ G) V = Gᵀ Σ⁻¹ B + Gᵀ λ_bound                                         Eq. (11.15)
//   active set       rows that the update of Eq. (4.7) leaves at a bound, or moves to a bound, are held there
//   a step           solves the free rows, follows that direction, clamped, while ½ λᵀ S λ - Bᵀ λ falls, and sweeps
//   interior point   if that stalls, as for many rows with friction between the same few bodies, whose active set is
//                    nearly arbitrary: engine/solvers/primal_interior_point.hpp
//   refinement       solves for the residual again, a few times, Eq. (11.14): λ = Σ⁻¹ (B - G V) cancels digits
//
// An unchanged active set takes one factorisation. Example: two bodies that touch at four points with friction have
// twelve rows, and a block of 6 x 6.
#include <optional>

#include "11_direct/direct.hpp"
#include "engine/linear/velocity_factors.hpp"
#include "engine/linear/velocity_system.hpp"
#include "engine/solvers/solver.hpp"

namespace spook {

/// A cache for the next step: which bodies share rows, and the order and pattern of the factors.
template <int Dof>
struct PrimalFactors {
  VelocitySystem<Dof> velocity_system;
  VelocityFactors factors;
};

/// Solves the rows within their bounds, from their current λ, which is within bounds, and its V. The history has the
/// residual of Eq. (4.8) after each factorisation. Returns nothing, and leaves rows and V unchanged, if Σ of a row is
/// 0, or if neither method converges: a pivot fails Eq. (11.4), or stop.max_sweeps factorisations do not suffice.
template <int Dof>
std::optional<SolveReport> primal_newton(std::vector<Row<Dof>>& rows,
                                         const std::vector<InverseMass<Dof>>& inverse_mass,
                                         std::vector<Twist<Dof>>& V, const StopRule& stop,
                                         PrimalFactors<Dof>& kept);

}  // namespace spook
