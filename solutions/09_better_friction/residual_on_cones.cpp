#include <algorithm>
#include <cmath>

#include "09_better_friction/cone_rows.hpp"

namespace spook {

template <int Dof>
double residual_on_cones(const std::vector<FrictionContact>& contacts, const std::vector<Row<Dof>>& rows,
                         const std::vector<Twist<Dof>>& V) {
  double largest = 0;
  const auto note = [&](double lacks) {
    if (std::isnan(lacks) || lacks > largest) largest = lacks;
  };
  auto contact = contacts.begin();
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const Row<Dof>& row = rows[k];
    const double r = row.B - row.Gi.dot(V[row.i]) - row.Gj.dot(V[row.j]) - row.Sigma * row.lambda;
    note(row.diagonal * std::abs(std::clamp(row.lambda + r / row.diagonal, row.lo, row.hi) - row.lambda));
    if (contact == contacts.end() || contact->normal != k) continue;
    const Row<Dof>&row1 = rows[k + 1], &row2 = rows[k + 2];
    const double s = stiffest_direction(row1, row2);
    note(s * (next_friction(*contact++, rows, V, s) - Vec2(row1.lambda, row2.lambda)).norm());  // Eq. (9.7)
    k += 2;
  }
  return largest;
}

template double residual_on_cones<3>(const std::vector<FrictionContact>&, const std::vector<Row<3>>&,
                                     const std::vector<Twist<3>>&);
template double residual_on_cones<6>(const std::vector<FrictionContact>&, const std::vector<Row<6>>&,
                                     const std::vector<Twist<6>>&);

}  // namespace spook
