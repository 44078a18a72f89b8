// Sweeps on Coulomb's cones: chapter 09, Eq. (9.3)-(9.6), with the current normal impulse; notes (3).
//
// Ignores the bounds of friction rows. A history entry is the result of a sweep. Has no cache.
#include "09_better_friction/better_friction.hpp"
#include "engine/solvers/registry.hpp"

namespace spook {

template <int Dof>
Solver<Dof> cone_gauss_seidel() {
  return {.solve = [](const SolverInput<Dof>& s) -> SolverResult {
            return cone_solve(s.constraints.friction, s.rows(), s.V, s.stop);
          },
          .friction = FrictionModel::cone};
}

template Solver<3> cone_gauss_seidel<3>();
template Solver<6> cone_gauss_seidel<6>();

}  // namespace spook
