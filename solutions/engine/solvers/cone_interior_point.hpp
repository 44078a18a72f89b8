#pragma once
// Interior-point method on Coulomb's cones: chapter 11's method, with friction among the bounds.
//
//   bounds       s z = τ, with slack s to a bound, and multiplier z of the bound: Eq. (11.5), (11.6)
//   friction     slip = -σ e,  e = λ_t/L,  R σ = τ,  with slack R = L (1 - |e|²) inside the disc of radius L, and slip
//                speed σ >= 0                                                        Eq. (9.3), made smooth
//   limit        L = μ (θ λ_n + (1 - θ) λ̄_n)
//   step         Newton's: a predictor to τ = 0, then a corrector to the τ that the predictor could reach: Eq. (11.10),
//                (11.11)
//   τ            from the target residual squared, over S_nn of each contact, so that masses may differ
//   start        inside: λ_n S_nn and the multiplier at least |B|, no friction. Near: from the current λ, where
//                λ_n S_nn and the multiplier keep their difference, and get the product w²; for friction,
//                s (L - |λ_t|) and the slip speed do
//   end          where nothing presses, λ_n S_nn and the multiplier are both about √τ, and so is the residual. Sweeps
//                solve these contacts, on which nothing rests: 15, as soon as the residual is 8 times what is enough
//
// With θ = 1 the limit follows the normal impulse within each Newton step. This problem has no energy that a solution
// minimises, so at high friction steps may become too short. With θ = θ_μ/μ, θ_μ < 1, the other part of the limit is
// lagged: it uses λ̄_n of the last Newton step. Each step then nearly minimises an energy. λ̄_n follows λ_n, but more
// slowly once it has oscillated.
//
//   C. Acary, F. Cadoux, C. Lemaréchal, J. Malick, A formulation of the linear discrete Coulomb friction problem via
//   convex optimization, ZAMM 91 (2011): fixing the limit during a solve.
#include "engine/solvers/cone_problem.hpp"

namespace spook {

/// One attempt of the method.
struct InteriorAttempt {
  double share = infinity;  ///< θ is min(1, share/μ)
  double width = 0;         ///< w of a start near the current λ; 0: starts inside [m/s]
  int factorisations;       ///< largest number of factorisations
};

/// Ends with the λ of the least residual found. Whenever the residual has fallen to 1e-3, 1e-6 and 1e-9 of the
/// right-hand side, or of the residual where it starts near λ, tries Newton's method for the `tolerance` [m/s]. Appends
/// the residual after each factorisation to the history; the last entry belongs to the final λ. Returns whether that
/// residual is at most `enough` [m/s].
template <int Dof>
bool cone_interior_point(ConeProblem<Dof>& problem, double tolerance, double enough,
                         const InteriorAttempt& attempt, std::vector<double>& history);

}  // namespace spook
