// Wrong: projects with std::min and std::max, which make a number of a NaN.
// Killed by: UpdateRow.KeepsANaN
// Says: std::clamp keeps a NaN
#include <algorithm>

#include "04_gauss_seidel/gauss_seidel.hpp"

namespace spook {

template <int Dof>
double update_row(Row<Dof>& row, std::vector<Twist<Dof>>& V) {
  // r = B - G V - Σ λ                                                            Eq. (4.6)
  const double r = row.B - row.Gi.dot(V[row.i]) - row.Gj.dot(V[row.j]) - row.Sigma * row.lambda;

  // Project the impulse itself, not its change: Δλ may be negative, λ may not.   Eq. (4.7)
  const double projected = std::min(row.hi, std::max(row.lo, row.lambda + r / row.diagonal));
  const double delta = projected - row.lambda;

  row.lambda = projected;
  apply_impulse(row, delta, V);
  return delta;
}

template double update_row<3>(Row<3>&, std::vector<Twist<3>>&);
template double update_row<6>(Row<6>&, std::vector<Twist<6>>&);

}  // namespace spook
