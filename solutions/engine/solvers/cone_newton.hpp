#pragma once
// Newton's method on the update of a contact or a row, linearised: Δλ = k - K G v.
//
//   row             free: G v + Σ Δλ = r;  at a bound: Δλ = bound - λ
//   open            λ_n + r_n/S_nn <= 0:            Δλ = -λ
//   sticking        |q| <= μ λ̂_n:                   G v + Σ Δλ = r
//   sliding         λ_t = μ λ_n d:                  Δλ_t = μ (λ_n + Δλ_n) d - λ_t   along d
//                   and, since d turns with q,      Δλ_t = c (λ_t + Δλ_t + (r_t - G v - Γ Δλ_t)/s) - λ_t   across d
//
//   r     Eq. (4.6)                  λ̂_n   λ_n + r_n/S_nn           d   q/|q|           Γ   Σ of friction
//   q     λ_t + r_t/s, Eq. (9.5), (9.6)                             c   μ λ̂_n/|q|, less than 1
//
// K of a sliding contact is not symmetric, since friction depends on the normal impulse, but not conversely.
//
// If redundant contacts can share forces in many ways, Δλ would be large and arbitrary. So Σ is enlarged by a fraction
// of S_kk that goes to 0 with the residual, which keeps convergence superlinear. After a step that increases the
// residual, λ returns to the best so far, and the fraction is ten times larger.
//
//   light       0 < λ̂_n S_nn < 0.1 of the largest |B_n|:   Δλ = 0, as soon as the residual is below 1e-3 of |B|
//
// A light contact is next to the tip of its cone, where a linear step says little: hundreds of them, such as the faces
// of cubes that stand side by side, would change their kind with every step. Sweeps after the step solve them: nothing
// rests on them, so that few sweeps suffice. While the residual is large, it is not known which contacts are light.
//
//   D. W. Marquardt, An algorithm for least-squares estimation of nonlinear parameters, J. SIAM 11 (1963): a diagonal
//   that grows while steps fail.
//   P. Alart, A. Curnier, A mixed formulation for frictional contact problems prone to Newton like solution methods,
//   Comput. Methods Appl. Mech. Eng. 92 (1991).
#include "engine/solvers/cone_problem.hpp"

namespace spook {

/// Takes Newton steps from the current λ, at most `most`. Stops at the fifth step that does not halve the least
/// residual so far; if the residual is at most 1e-8 of the largest |B|, the first such step suffices. Ends with the λ
/// of the least residual. Appends the residual after each factorisation to the history; the last entry belongs to the
/// final λ. Returns whether the problem is solved to the tolerance [m/s], or to round-off.
template <int Dof>
bool cone_newton(ConeProblem<Dof>& problem, double tolerance, int most, std::vector<double>& history);

/// Returns the share of light contacts; 0 while it is not known which are.
template <int Dof>
double share_of_light(const ConeProblem<Dof>& problem);

}  // namespace spook
