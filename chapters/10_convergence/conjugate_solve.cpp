#include "10_convergence/convergence.hpp"
#include "common/not_implemented.hpp"
#include "common/require.hpp"

namespace spook {

template <int Dof>
SolveReport conjugate_solve(std::vector<Row<Dof>>& rows, std::vector<Twist<Dof>>& V, const StopRule& stop) {
  // Eq. (10.6)-(10.9); what goes in and out, and in which units, is in convergence.hpp.
  not_implemented("10.8 conjugate_solve", rows, V, stop);
}

// Compiles the template for point masses (3) and for rigid bodies (6): leave these two lines as they are.
template SolveReport conjugate_solve<3>(std::vector<Row<3>>&, std::vector<Twist<3>>&, const StopRule&);
template SolveReport conjugate_solve<6>(std::vector<Row<6>>&, std::vector<Twist<6>>&, const StopRule&);

}  // namespace spook
