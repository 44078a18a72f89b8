#pragma once
// Coulomb's cones from within: chapter 11's interior point method, with friction among its bounds.
//
//   bounds       s z = τ, with the room s to a bound and the push z off it: Eq. (11.5), (11.6)
//   friction     slip = -σ e,  e = λ_t/L,  R σ = τ,  with the room R = L (1 - |e|²) inside the disc of radius L, and σ >= 0
//                the speed of the slip                                               Eq. (9.3), made smooth
//   limit        L = μ (θ λ_n + (1 - θ) λ̄_n)
//   step         Newton's, first straight at τ = 0, then to the τ that this one could reach: Eq. (11.10), (11.11)
//   τ            is a part of the squared residual asked for, over S_nn of each contact, so that masses may differ
//
// With θ = 1 the limit follows the normal impulse within each step. The problem is then not one of least energy, and
// where friction is high steps may become short before it is solved. With θ = θ_μ/μ, θ_μ < 1, the rest of the limit is
// the λ̄_n of the step before: each step is nearly one of least energy, and λ̄_n follows, slower where it goes to and fro.
//
//   C. Acary, F. Cadoux, C. Lemaréchal, J. Malick, A formulation of the linear discrete Coulomb friction problem via
//   convex optimization, ZAMM 91 (2011): why the limit is held while the rest is solved.
#include "engine/solvers/cone_problem.hpp"

namespace spook {

/// How the limit of friction follows the normal impulse: θ is min(1, share/μ).
struct LimitRule {
  double share;        ///< infinite: θ = 1
  int factorisations;  ///< at most
};

/// Starts well inside all bounds, from the normal impulses as they are, and ends with the λ of the least residual on the
/// way. At a thousandth, a millionth and a billionth of what was asked for, Newton's method tries to get to the
/// tolerance [m/s] from there. Adds the residual after each factorisation to the history; the last one is that of the λ with which it ends.
/// Returns whether this is at most `enough` [m/s].
template <int Dof>
bool cone_interior_point(ConeProblem<Dof>& problem, double tolerance, double enough, const LimitRule& rule,
                         std::vector<double>& history);

}  // namespace spook
