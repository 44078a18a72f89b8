#pragma once
// Contacts on Coulomb's cones, with factors over bodies. Methods are tried in this order until the residual is small:
//
//   a sweep          from the current λ: bodies at rest are solved by it
//   Newton           engine/solvers/cone_newton.hpp, as long as the residual falls
//   interior point   engine/solvers/cone_interior_point.hpp, near the best λ so far. w is 3, 30, 300 times the
//                    residual; or once |B|/10, if the residual exceeds |B|/1000
//   Newton           now, if not before
//   interior point   from inside
//   sweeps           accelerated, Eq. (10.14), from the best λ so far; only if 1e-4 of the largest |B| is enough
//   interior point   with lagged friction limits, three times
//   sweeps           alternating with Newton, from the best λ so far
#include "engine/solvers/cone_problem.hpp"
#include "engine/solvers/solver_result.hpp"

namespace spook {

/// Limits of the attempts.
struct ConeEffort {
  /// Tries Newton's method before the interior point. If false, only where a tenth of the contacts is light, next to
  /// the tips of their cones: there it takes fewer factorisations, and elsewhere more.
  bool newton_first = true;
  int factorisations = 300;  ///< largest number of factorisations
  /// The residual, over the largest |B|, at which no further method is tried once one interior-point attempt has ended.
  double suffices = 0;
};

/// Starts from the current λ and V. A problem counts as solved if the residual, Eq. (9.7), is at most the tolerance or
/// round-off. If that cannot be reached, 1e-8 of the largest |B| suffices, and 1e-6 with lagged limits. Each history
/// entry is the residual after a factorisation; the last entry belongs to the final λ. All rows must have Σ > 0.
template <int Dof>
SolverResult solve_on_cones(ConeProblem<Dof>& problem, double tolerance, const ConeEffort& effort = {});

}  // namespace spook
