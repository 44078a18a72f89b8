#include "engine/solvers/frontal_direct.hpp"

#include "common/require.hpp"
#include "engine/solvers/solve_inside.hpp"

namespace spook {

template <int Dof>
std::optional<SolveReport> frontal_direct(std::vector<Row<Dof>>& rows, std::vector<Twist<Dof>>& V,
                                          const StopRule& stop, FrontalFactors& kept) {
  require_positive("max_sweeps", stop.max_sweeps);
  require_not_negative("tolerance", stop.tolerance);
  if (rows.empty() || !kept.factors.factorise(kept.row_system.matrix(rows))) return {};
  Vector x(std::ssize(rows));
  return solve_inside(rows, V, stop, {}, x, [&](Vector& values) { values = kept.factors.solve(values); });
}

template std::optional<SolveReport> frontal_direct<3>(std::vector<Row<3>>&, std::vector<Twist<3>>&,
                                                      const StopRule&, FrontalFactors&);
template std::optional<SolveReport> frontal_direct<6>(std::vector<Row<6>>&, std::vector<Twist<6>>&,
                                                      const StopRule&, FrontalFactors&);

}  // namespace spook
