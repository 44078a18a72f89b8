// The direct solver: chapter 11, sparse factors over rows or over bodies; dense factors for a few rows; notes, "direct
// methods".
//
// A history entry belongs to a factorisation. Updates no rows, unless factors fail and sweeps continue. Starts from the
// impulses of the last step. Caches the order and the pattern of sparse factors.
#include "engine/solvers/registry.hpp"
#include "engine/solvers/small_direct.hpp"
#include "engine/solvers/solve_directly.hpp"

namespace spook {

template <int Dof>
Solver<Dof> direct() {
  const auto solve = [factors = ScratchCache<RowAndVelocityFactors<Dof>>()](const SolverInput<Dof>& s) mutable {
    if (auto solved = small_direct(s.rows(), s.V, s.stop)) return without_updates(*std::move(solved));
    start_from(s.last.impulses(s.constraints, s.contacts, s.h, s.threads), s.rows(), s.V);
    return without_updates(solve_directly(s.rows(), s.bodies.motion.inverse_mass, s.V, s.stop, *factors));
  };
  return {.solve = solve, .wants_last = true};
}

template Solver<3> direct<3>();
template Solver<6> direct<6>();

}  // namespace spook
