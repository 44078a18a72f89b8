// Wrong: returns |Δλ_t|.
// Killed by: UpdateFriction.DividesByTheStiffestDirection
// Says: This is |Δλ_t|, an impulse
#include <cmath>

#include "09_better_friction/better_friction.hpp"

namespace spook {

template <int Dof>
double update_friction(const FrictionContact& contact, std::vector<Row<Dof>>& rows,
                       std::vector<Twist<Dof>>& V) {
  Row<Dof>&row1 = rows[contact.normal + 1], &row2 = rows[contact.normal + 2];
  const auto lacks = [&](const Row<Dof>& row) {
    return row.B - row.Gi.dot(V[row.i]) - row.Gj.dot(V[row.j]) - row.Sigma * row.lambda;
  };
  const double S12 = row1.Gi.dot(row2.MinvGi) + row1.Gj.dot(row2.MinvGj);
  const double s = (row1.diagonal + row2.diagonal) / 2 + std::hypot((row1.diagonal - row2.diagonal) / 2, S12);
  const Vec2 before(row1.lambda, row2.lambda), r(lacks(row1), lacks(row2));
  const double radius = contact.mu * rows[contact.normal].lambda;
  const Vec2 after = onto_disc(before + r / s, radius);
  const Vec2 change = after - before;
  row1.lambda = after[0];
  row2.lambda = after[1];
  apply_impulse(row1, change[0], V);
  apply_impulse(row2, change[1], V);
  return change.norm();
}

template double update_friction<3>(const FrictionContact&, std::vector<Row<3>>&, std::vector<Twist<3>>&);
template double update_friction<6>(const FrictionContact&, std::vector<Row<6>>&, std::vector<Twist<6>>&);

}  // namespace spook
