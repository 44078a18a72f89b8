// Projected conjugate gradients, preconditioned by sweeps: chapter 10, Eq. (10.6)-(10.9); notes, "conjugate gradient".
//
// A history entry belongs to an iteration, which costs four sweeps: two for the preconditioner, one for the residual,
// one for S p. Has no cache.
#include "10_convergence/convergence.hpp"
#include "engine/solvers/registry.hpp"

namespace spook {

template <int Dof>
Solver<Dof> conjugate_gradients() {
  return {.solve = [](const SolverInput<Dof>& s) {
    SolverResult result = conjugate_solve(s.rows(), s.V, s.stop);
    result.row_updates = 4 * std::ssize(result.report.history) * std::ssize(s.rows());
    return result;
  }};
}

template Solver<3> conjugate_gradients<3>();
template Solver<6> conjugate_gradients<6>();

}  // namespace spook
