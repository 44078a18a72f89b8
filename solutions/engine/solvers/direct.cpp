// The direct solver: chapter 11, sparse factors of S, Eq. (11.1), (11.3), and bounds from within, Eq. (11.5)-(11.14);
// notes, "direct methods".
//
// One entry of its history is of a factorisation; it updates no rows, unless it has trouble and goes on by sweeps. Keeps
// the order and the pattern of the factors, which the next step most often has again.
#include "11_direct/direct.hpp"
#include "engine/solvers.hpp"

namespace spook {

template <int Dof>
Solver<Dof> direct() {
  return {.solve = [factors = Kept<Factors>()](const System<Dof>& s) mutable {
    Outcome outcome = direct_solve(s.rows, s.V, s.stop, *factors);
    outcome.row_updates = 0;
    return outcome;
  }};
}

template Solver<3> direct<3>();
template Solver<6> direct<6>();

}  // namespace spook
