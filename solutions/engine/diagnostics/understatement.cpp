#include "engine/diagnostics/understatement.hpp"

#include <algorithm>

namespace spook {

template <int Dof>
double understatement(const World<Dof>& world) {
  const std::vector<Row<Dof>>& rows = world.rows();
  const std::vector<Twist<Dof>>& V = world.velocity_changes();
  const bool on_cones = world.settings().solver.friction == FrictionModel::cone && !world.contacts().empty();
  if (V.size() != world.bodies().size() || on_cones) return infinity;
  std::vector<double> d;
  std::vector<Twist<Dof>> moved(V.size(), Twist<Dof>::Zero());
  double by_diagonal = 0, by_softness = 0, by_bodies = 0;
  for (const Row<Dof>& row : rows) {
    const double r = row.B - row.Sigma * row.lambda - row.Gi.dot(V[row.i]) - row.Gj.dot(V[row.j]);
    d.push_back(std::clamp(row.lambda + r / row.diagonal, row.lo, row.hi) - row.lambda);
    by_diagonal += row.diagonal * d.back() * d.back();
    by_softness += row.Sigma * d.back() * d.back();
    moved[row.i] += row.MinvGi * d.back();
    moved[row.j] += row.MinvGj * d.back();
  }
  for (std::size_t k = 0; k < rows.size(); ++k)
    by_bodies += d[k] * (rows[k].Gi.dot(moved[rows[k].i]) + rows[k].Gj.dot(moved[rows[k].j]));
  const double all = by_bodies + by_softness;
  return all > 0 ? by_bodies / all * (by_diagonal / all) : infinity;
}

template double understatement(const World<3>&);
template double understatement(const World<6>&);

}  // namespace spook
