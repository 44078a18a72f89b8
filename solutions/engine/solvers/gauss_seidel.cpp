// Projected Gauss-Seidel: chapter 04, Eq. (4.6), (4.7), in the order of the rows; notes, "Gauss-Seidel".
//
// A history entry is the result of a sweep. Has no cache.
#include "engine/solvers/registry.hpp"

namespace spook {

template <int Dof>
Solver<Dof> gauss_seidel() {
  return {.solve = [](const SolverInput<Dof>& s) -> SolverResult { return solve(s.rows(), s.V, s.stop); }};
}

template Solver<3> gauss_seidel<3>();
template Solver<6> gauss_seidel<6>();

}  // namespace spook
