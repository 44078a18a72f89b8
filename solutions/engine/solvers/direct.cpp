// The direct solver: chapter 11, sparse factors, of rows or of bodies; notes, "direct methods". A few rows have dense ones.
//
// One entry of its history is of a factorisation; it updates no rows, unless it has trouble and goes on by sweeps. Begins
// with the impulses of the last step, and keeps the order and the pattern of the factors, where they are sparse.
#include "engine/solvers/registry.hpp"
#include "engine/solvers/small_direct.hpp"
#include "engine/solvers/solve_directly.hpp"

namespace spook {

template <int Dof>
Solver<Dof> direct() {
  const auto solve = [factors = ScratchCache<RowAndVelocityFactors<Dof>>()](const SolverInput<Dof>& s) mutable {
    if (auto solved = small_direct(s.rows, s.V, s.stop)) return without_updates(*std::move(solved));
    start_from(s.last.impulses(s.rows, s.first_contact_row, s.contacts, s.h), s.rows, s.V);
    return without_updates(solve_directly(s.rows, s.bodies.motion.inverse_mass, s.V, s.stop, *factors));
  };
  return {.solve = solve, .wants_last = true};
}

template Solver<3> direct<3>();
template Solver<6> direct<6>();

}  // namespace spook
