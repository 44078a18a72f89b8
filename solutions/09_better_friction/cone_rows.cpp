#include "09_better_friction/cone_rows.hpp"

#include <cmath>

namespace spook {

template <int Dof>
double stiffest_direction(const Row<Dof>& row1, const Row<Dof>& row2) {
  const double S12 = row1.Gi.dot(row2.MinvGi) + row1.Gj.dot(row2.MinvGj);
  const double mean = (row1.diagonal + row2.diagonal) / 2,
               half_difference = (row1.diagonal - row2.diagonal) / 2;
  return mean + std::sqrt(half_difference * half_difference + S12 * S12);  // Eq. (9.5)
}

template <int Dof>
Vec2 next_friction(const FrictionContact& contact, const std::vector<Row<Dof>>& rows,
                   const std::vector<Twist<Dof>>& V, double s) {
  const double mass = 1 / s;
  const auto unprojected = [&](const Row<Dof>& row) {
    const double r = row.B - row.Gi.dot(V[row.i]) - row.Gj.dot(V[row.j]) - row.Sigma * row.lambda;
    return row.lambda + mass * r;
  };
  const Vec2 wanted(unprojected(rows[contact.normal + 1]), unprojected(rows[contact.normal + 2]));
  return onto_disc(wanted, contact.mu * rows[contact.normal].lambda);  // Eq. (9.6)
}

template double stiffest_direction<3>(const Row<3>&, const Row<3>&);
template double stiffest_direction<6>(const Row<6>&, const Row<6>&);
template Vec2 next_friction<3>(const FrictionContact&, const std::vector<Row<3>>&, const std::vector<Twist<3>>&,
                               double);
template Vec2 next_friction<6>(const FrictionContact&, const std::vector<Row<6>>&, const std::vector<Twist<6>>&,
                               double);

}  // namespace spook
