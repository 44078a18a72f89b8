#pragma once
// Newton's method on what an update of a contact, or of a row, would do, made linear: Δλ = k - K G v.
//
//   free, or held   of a row:  G v + Σ Δλ = r,  or Δλ = bound - λ
//   open            λ_n + r_n/S_nn <= 0:            Δλ = -λ
//   sticks          |q| <= μ λ̂_n:                   G v + Σ Δλ = r
//   slides          λ_t = μ λ_n d, that is          Δλ_t = μ (λ_n + Δλ_n) d - λ_t   along d
//                   and, as d turns with q,         Δλ_t = c (λ_t + Δλ_t + (r_t - G v - Γ Δλ_t)/s) - λ_t   across it
//
//   r     Eq. (4.6)                  λ̂_n   λ_n + r_n/S_nn           d   q/|q|           Γ   Σ of friction
//   q     λ_t + r_t/s, Eq. (9.5), (9.6)                             c   μ λ̂_n/|q|, less than 1
//
// K is not symmetric where a contact slides: a larger normal impulse gives more friction.
//
// Where forces could be shared among contacts in many ways, Δλ would be large and arbitrary: Σ is enlarged by a part of
// S_kk that goes to 0 with the residual, so that convergence stays faster than linear.
//
//   P. Alart, A. Curnier, A mixed formulation for frictional contact problems prone to Newton like solution methods,
//   Comput. Methods Appl. Mech. Eng. 92 (1991).
#include "engine/solvers/cone_problem.hpp"

namespace spook {

/// Takes steps of Newton's method from λ as it is, at most `most`, as long as the residual falls to half of the least
/// so far, or once does not. Adds the residual after each factorisation to the history. Returns whether it is
/// solved: to the tolerance [m/s], or to round-off.
template <int Dof>
bool cone_newton(ConeProblem<Dof>& problem, double tolerance, int most, std::vector<double>& history);

}  // namespace spook
