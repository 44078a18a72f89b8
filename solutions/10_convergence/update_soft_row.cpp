#include <algorithm>

#include "10_convergence/convergence.hpp"

namespace spook {

template <int Dof>
double update_soft_row(double h, const SoftParameters& soft, double gap, Row<Dof>& row,
                       std::vector<Twist<Dof>>& W) {
  // The target of u, and how soft the row is.                              Eq. (10.21)
  const bool open = row.lo == 0 && gap > 0;
  const double target = open ? -gap / h : -soft.bias_rate * gap;
  const double mass_scale = open ? 1 : soft.mass_scale;
  const double impulse_scale = open ? 0 : soft.impulse_scale;

  const double S = row.Gi.dot(row.MinvGi) + row.Gj.dot(row.MinvGj);
  const double u = row.Gi.dot(W[row.i]) + row.Gj.dot(W[row.j]);
  const double change = mass_scale * (target - u) / S - impulse_scale * row.lambda;

  // Bounds hold for the impulse, not for its change.                       Eq. (4.7)
  const double projected = std::clamp(row.lambda + change, row.lo, row.hi);
  const double delta = projected - row.lambda;
  row.lambda = projected;
  W[row.i] += delta * row.MinvGi;
  W[row.j] += delta * row.MinvGj;
  return delta;
}

template double update_soft_row<3>(double, const SoftParameters&, double, Row<3>&, std::vector<Twist<3>>&);
template double update_soft_row<6>(double, const SoftParameters&, double, Row<6>&, std::vector<Twist<6>>&);

}  // namespace spook
