#include "04_gauss_seidel/gauss_seidel.hpp"
#include "common/not_implemented.hpp"
#include "common/require.hpp"

namespace spook {

template <int Dof>
SolveReport solve(std::vector<Row<Dof>>& rows, std::vector<Twist<Dof>>& V, const StopRule& stop) {
  // Eq. (4.9); what goes in and out, and in which units, is in gauss_seidel.hpp.
  not_implemented("4.6 solve", rows, V, stop);
}

// Compiles the template for point masses (3) and for rigid bodies (6): leave these two lines as they are.
template SolveReport solve<3>(std::vector<Row<3>>&, std::vector<Twist<3>>&, const StopRule&);
template SolveReport solve<6>(std::vector<Row<6>>&, std::vector<Twist<6>>&, const StopRule&);

}  // namespace spook
