#include "09_better_friction/better_friction.hpp"
#include "common/require.hpp"

namespace spook {

template <int Dof>
SolveReport two_pass_solve(const std::vector<FrictionContact>& contacts, std::vector<Row<Dof>>& rows,
                           std::vector<Twist<Dof>>& V, const StopRule& stop) {
  require_positive("max_sweeps", stop.max_sweeps);
  require_not_negative("tolerance", stop.tolerance);
  for (const FrictionContact& contact : contacts)
    for (const std::size_t k : {contact.normal + 1, contact.normal + 2}) {
      apply_impulse(rows[k], -rows[k].lambda, V);
      rows[k].lambda = rows[k].lo = rows[k].hi = 0;
    }
  const SolveReport first = solve(rows, V, stop);
  limit_friction(contacts, rows);
  SolveReport second = solve(rows, V, stop);
  second.history.insert(second.history.begin(), first.history.begin(), first.history.end());
  return second;
}

template SolveReport two_pass_solve<3>(const std::vector<FrictionContact>&, std::vector<Row<3>>&,
                                       std::vector<Twist<3>>&, const StopRule&);
template SolveReport two_pass_solve<6>(const std::vector<FrictionContact>&, std::vector<Row<6>>&,
                                       std::vector<Twist<6>>&, const StopRule&);

}  // namespace spook
