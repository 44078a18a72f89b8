#pragma once
// Rows by factors, on whichever unknowns are fewer.
//
//   on rows     S λ = B, Eq. (11.1), (11.3), bounds from within, Eq. (11.5)-(11.14): chapter 11's direct_solve, from scratch
//   on bodies   Eq. (11.15), from the λ that the rows have: engine/solvers/primal_newton.hpp; should it not settle, on rows
#include "engine/solvers/primal_newton.hpp"

namespace spook {

/// Their orders and patterns, which the next step most often has again.
template <int Dof>
struct RowAndVelocityFactors {
  Factors on_rows;
  PrimalFactors<Dof> on_bodies;
};

/// Solves the rows within their bounds. On entry V is M⁻¹ Gᵀ λ of their λ, each within its bounds; `inverse_mass` and V
/// have an entry a body. One entry of the history is of a factorisation, of which there are at most stop.max_sweeps on
/// either; should neither do, sweeps go on from there, and `trouble` says so.
template <int Dof>
SolveReport solve_directly(std::vector<Row<Dof>>& rows, const std::vector<InverseMass<Dof>>& inverse_mass,
                           std::vector<Twist<Dof>>& V, const StopRule& stop,
                           RowAndVelocityFactors<Dof>& factors);

/// Lets rows begin with `impulses`, one each or none at all, as far as their bounds allow; V as they make it.
template <int Dof>
void start_from(const std::vector<double>& impulses, std::vector<Row<Dof>>& rows, std::vector<Twist<Dof>>& V);

}  // namespace spook
