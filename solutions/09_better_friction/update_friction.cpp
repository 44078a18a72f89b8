#include "09_better_friction/cone_rows.hpp"

namespace spook {

template <int Dof>
double update_friction(const FrictionContact& contact, std::vector<Row<Dof>>& rows,
                       std::vector<Twist<Dof>>& V) {
  Row<Dof>&row1 = rows[contact.normal + 1], &row2 = rows[contact.normal + 2];
  const double s = stiffest_direction(row1, row2);
  const Vec2 before(row1.lambda, row2.lambda), after = next_friction(contact, rows, V, s),
                                               change = after - before;
  row1.lambda = after[0];
  row2.lambda = after[1];
  apply_impulse(row1, change[0], V);
  apply_impulse(row2, change[1], V);
  return s * change.norm();
}

template double update_friction<3>(const FrictionContact&, std::vector<Row<3>>&, std::vector<Twist<3>>&);
template double update_friction<6>(const FrictionContact&, std::vector<Row<6>>&, std::vector<Twist<6>>&);

}  // namespace spook
