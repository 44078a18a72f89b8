// Wrong: projects on a contact's bounds, whatever the row's.
// Killed by: Residual.ProjectsOnTheRowsOwnBounds
// Says: projected on 0 and infinity
#include <algorithm>
#include <cmath>

#include "04_gauss_seidel/gauss_seidel.hpp"

namespace spook {

template <int Dof>
double residual(const std::vector<Row<Dof>>& rows, const std::vector<Twist<Dof>>& V) {
  double largest = 0;
  for (const Row<Dof>& row : rows) {
    const double r = row.B - row.Gi.dot(V[row.i]) - row.Gj.dot(V[row.j]) - row.Sigma * row.lambda;
    const double next = std::clamp(row.lambda + r / row.diagonal, 0.0, infinity);
    const double lacks = row.diagonal * std::abs(next - row.lambda);
    if (std::isnan(lacks) || lacks > largest) largest = lacks;
  }
  return largest;
}

template double residual<3>(const std::vector<Row<3>>&, const std::vector<Twist<3>>&);
template double residual<6>(const std::vector<Row<6>>&, const std::vector<Twist<6>>&);

}  // namespace spook
