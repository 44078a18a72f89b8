#include <algorithm>

#include "04_gauss_seidel/gauss_seidel.hpp"

namespace spook {

template <int Dof>
double update_row(Row<Dof>& row, std::vector<Twist<Dof>>& V) {
  // r = B - G V - Σ λ                                                            Eq. (4.6)
  const double r = row.B - row.Gi.dot(V[row.i]) - row.Gj.dot(V[row.j]) - row.Sigma * row.lambda;

  // The division needs no velocity: a processor does it while it waits for r.
  const double mass = 1 / row.diagonal;

  // Project the impulse itself, not its change: Δλ may be negative, λ may not.   Eq. (4.7)
  const double projected = std::clamp(row.lambda + mass * r, row.lo, row.hi);
  const double delta = projected - row.lambda;

  row.lambda = projected;
  apply_impulse(row, delta, V);
  return delta;
}

template double update_row<3>(Row<3>&, std::vector<Twist<3>>&);
template double update_row<6>(Row<6>&, std::vector<Twist<6>>&);

}  // namespace spook
