#include "11_direct/direct.hpp"
#include "common/not_implemented.hpp"
#include "common/require.hpp"

namespace spook {

template <int Dof>
SolveReport direct_solve(std::vector<Row<Dof>>& rows, std::vector<Twist<Dof>>& V, const StopRule& stop,
                         Factors& factors) {
  // Eq. (11.1), (11.3), (11.14); what goes in and out, and in which units, is in direct.hpp.
  not_implemented("11.11 direct_solve", rows, V, stop, factors);
}

// Compiles the template for point masses (3) and for rigid bodies (6): leave these two lines as they are.
template SolveReport direct_solve<3>(std::vector<Row<3>>&, std::vector<Twist<3>>&, const StopRule&, Factors&);
template SolveReport direct_solve<6>(std::vector<Row<6>>&, std::vector<Twist<6>>&, const StopRule&, Factors&);

}  // namespace spook
