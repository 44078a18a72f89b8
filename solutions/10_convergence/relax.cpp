#include "10_convergence/convergence.hpp"

namespace spook {

template <int Dof>
SolveReport relax(const Motion<Dof>& motion, std::vector<Row<Dof>>& rows, std::vector<Twist<Dof>>& V,
                  const StopRule& stop) {
  std::vector<Row<Dof>> rigid = rows;
  for (Row<Dof>& row : rigid) {  // Eq. (10.15): a = 0, b = 1, Σ = 0
    const Twist<Dof> free_i = motion.W[row.i] + motion.Wf[row.i];
    const Twist<Dof> free_j = motion.W[row.j] + motion.Wf[row.j];
    row.B = -row.Gi.dot(free_i) - row.Gj.dot(free_j);
    row.Sigma = 0;
    row.diagonal = row.Gi.dot(row.MinvGi) + row.Gj.dot(row.MinvGj);
  }
  const SolveReport report = solve(rigid, V, stop);
  for (std::size_t k = 0; k < rows.size(); ++k) rows[k].lambda = rigid[k].lambda;
  return report;
}

template SolveReport relax<3>(const Motion<3>&, std::vector<Row<3>>&, std::vector<Twist<3>>&, const StopRule&);
template SolveReport relax<6>(const Motion<6>&, std::vector<Row<6>>&, std::vector<Twist<6>>&, const StopRule&);

}  // namespace spook
