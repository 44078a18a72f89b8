#include "09_better_friction/better_friction.hpp"
#include "common/require.hpp"

namespace spook {

template <int Dof>
SolveReport cone_solve(const std::vector<FrictionContact>& contacts, std::vector<Row<Dof>>& rows,
                       std::vector<Twist<Dof>>& V, const StopRule& stop) {
  require_positive("max_sweeps", stop.max_sweeps);
  require_not_negative("tolerance", stop.tolerance);

  SolveReport report;
  report.converged = rows.empty();
  while (!report.converged && std::ssize(report.history) < stop.max_sweeps) {
    report.history.push_back(sweep_on_cones(contacts, rows, V));
    report.converged = report.history.back() <= stop.tolerance;
  }
  return report;
}

template SolveReport cone_solve<3>(const std::vector<FrictionContact>&, std::vector<Row<3>>&,
                                   std::vector<Twist<3>>&, const StopRule&);
template SolveReport cone_solve<6>(const std::vector<FrictionContact>&, std::vector<Row<6>>&,
                                   std::vector<Twist<6>>&, const StopRule&);

}  // namespace spook
