// Wrong: never looks at the tolerance.
// Killed by: Solve.StopsAtTheFirstSweepThatIsGoodEnough
// Says: A sweep that returns at most the tolerance is the last one
#include "04_gauss_seidel/gauss_seidel.hpp"
#include "common/require.hpp"

namespace spook {

template <int Dof>
SolveReport solve(std::vector<Row<Dof>>& rows, std::vector<Twist<Dof>>& V, const StopRule& stop) {
  require_positive("max_sweeps", stop.max_sweeps);
  require_not_negative("tolerance", stop.tolerance);

  SolveReport report;
  report.converged = rows.empty();
  while (!rows.empty() && std::ssize(report.history) < stop.max_sweeps) {
    report.history.push_back(sweep(rows, V));
    report.converged = report.history.back() <= stop.tolerance;
  }
  return report;
}

template SolveReport solve<3>(std::vector<Row<3>>&, std::vector<Twist<3>>&, const StopRule&);
template SolveReport solve<6>(std::vector<Row<6>>&, std::vector<Twist<6>>&, const StopRule&);

}  // namespace spook
