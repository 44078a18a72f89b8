#include "09_better_friction/better_friction.hpp"
#include "common/not_implemented.hpp"
#include "common/require.hpp"

namespace spook {

template <int Dof>
SolveReport cone_solve(const std::vector<FrictionContact>& contacts, std::vector<Row<Dof>>& rows,
                       std::vector<Twist<Dof>>& V, const StopRule& stop) {
  // Eq. (9.6), (4.9); what goes in and out, and in which units, is in better_friction.hpp.
  not_implemented("9.8 cone_solve", contacts, rows, V, stop);
}

// Compiles the template for point masses (3) and for rigid bodies (6): leave these two lines as they are.
template SolveReport cone_solve<3>(const std::vector<FrictionContact>&, std::vector<Row<3>>&,
                                   std::vector<Twist<3>>&, const StopRule&);
template SolveReport cone_solve<6>(const std::vector<FrictionContact>&, std::vector<Row<6>>&,
                                   std::vector<Twist<6>>&, const StopRule&);

}  // namespace spook
