#pragma once
// Contacts on Coulomb's cones, by factors on bodies: what is tried in turn, until the residual says that it is solved.
//
//   a look          λ as it is, after a sweep: what rests is solved already
//   Newton          engine/solvers/cone_newton.hpp, while the residual halves
//   from within     engine/solvers/cone_interior_point.hpp, first with limits that follow at once, then with lagged ones
//   sweeps          with Newton in between
#include "engine/solvers/cone_problem.hpp"
#include "engine/solvers/solver_result.hpp"

namespace spook {

/// Begins with λ and V as they are. It is solved where the residual, Eq. (9.7), is at most the tolerance or a rounding.
/// Where Newton's method cannot get there, a hundred-millionth of the largest |B| is enough, and a millionth where lagged
/// limits were needed. Makes at most `most` factorisations. Each entry of the history is the residual after a
/// factorisation; the last one is that of λ. All rows must have Σ > 0.
template <int Dof>
SolverResult solve_on_cones(ConeProblem<Dof>& problem, double tolerance, int most = 300);

}  // namespace spook
