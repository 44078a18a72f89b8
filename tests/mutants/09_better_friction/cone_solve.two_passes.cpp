// Wrong: is the solver of 9.3.
// Killed by: ConeSolve.SlowsABlockAlikeInAllDirections
// Says: This is a box
#include "09_better_friction/better_friction.hpp"

namespace spook {

template <int Dof>
SolveReport cone_solve(const std::vector<FrictionContact>& contacts, std::vector<Row<Dof>>& rows,
                       std::vector<Twist<Dof>>& V, const StopRule& stop) {
  return two_pass_solve(contacts, rows, V, stop);
}

template SolveReport cone_solve<3>(const std::vector<FrictionContact>&, std::vector<Row<3>>&,
                                   std::vector<Twist<3>>&, const StopRule&);
template SolveReport cone_solve<6>(const std::vector<FrictionContact>&, std::vector<Row<6>>&,
                                   std::vector<Twist<6>>&, const StopRule&);

}  // namespace spook
