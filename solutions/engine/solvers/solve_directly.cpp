#include "engine/solvers/solve_directly.hpp"

#include <algorithm>

#include "engine/solvers/factor_cost.hpp"

namespace spook {

template <int Dof>
SolveReport solve_directly(std::vector<Row<Dof>>& rows, const std::vector<InverseMass<Dof>>& inverse_mass,
                           std::vector<Twist<Dof>>& V, const StopRule& stop,
                           RowAndVelocityFactors<Dof>& factors) {
  if (wants_bodies(rows))
    if (auto solved = primal_newton(rows, inverse_mass, V, stop, factors.on_bodies)) return *std::move(solved);
  return direct_solve(rows, V, stop, factors.on_rows);
}

template <int Dof>
void start_from(const std::vector<double>& impulses, std::vector<Row<Dof>>& rows, std::vector<Twist<Dof>>& V) {
  std::fill(V.begin(), V.end(), Twist<Dof>::Zero());
  for (std::size_t k = 0; k < rows.size(); ++k) {
    rows[k].lambda = std::clamp(impulses.empty() ? 0 : impulses[k], rows[k].lo, rows[k].hi);
    apply_impulse(rows[k], rows[k].lambda, V);
  }
}

template SolveReport solve_directly<3>(std::vector<Row<3>>&, const std::vector<InverseMass<3>>&,
                                       std::vector<Twist<3>>&, const StopRule&, RowAndVelocityFactors<3>&);
template SolveReport solve_directly<6>(std::vector<Row<6>>&, const std::vector<InverseMass<6>>&,
                                       std::vector<Twist<6>>&, const StopRule&, RowAndVelocityFactors<6>&);
template void start_from<3>(const std::vector<double>&, std::vector<Row<3>>&, std::vector<Twist<3>>&);
template void start_from<6>(const std::vector<double>&, std::vector<Row<6>>&, std::vector<Twist<6>>&);

}  // namespace spook
