#include "engine/solvers/row_order.hpp"

#include "10_convergence/convergence.hpp"

namespace spook {

template <int Dof>
SolveReport solve_in_order(const std::vector<int>& order, std::vector<Row<Dof>>& rows,
                           std::vector<Twist<Dof>>& V, const StopRule& stop) {
  SolveReport report;
  while (!report.converged && std::ssize(report.history) < stop.max_sweeps) {
    report.history.push_back(sweep_in_order(order, rows, V));
    report.converged = report.history.back() <= stop.tolerance;
  }
  return report;
}

std::vector<int> interleaved_order(std::size_t n) {
  const int half = static_cast<int>(n + 1) / 2;
  std::vector<int> order(n);
  for (std::size_t k = 0; k < n; ++k) order[k] = static_cast<int>(k) / 2 + (k % 2 == 0 ? 0 : half);
  return order;
}

template SolveReport solve_in_order<3>(const std::vector<int>&, std::vector<Row<3>>&, std::vector<Twist<3>>&,
                                       const StopRule&);
template SolveReport solve_in_order<6>(const std::vector<int>&, std::vector<Row<6>>&, std::vector<Twist<6>>&,
                                       const StopRule&);

}  // namespace spook
