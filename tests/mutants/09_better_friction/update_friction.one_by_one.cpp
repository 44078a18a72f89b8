// Wrong: updates the rows one after the other, and then shortens.
// Killed by: UpdateFriction.DividesByTheStiffestDirection
// Says: The two rows go together
#include "09_better_friction/cone_rows.hpp"

namespace spook {

template <int Dof>
double update_friction(const FrictionContact& contact, std::vector<Row<Dof>>& rows,
                       std::vector<Twist<Dof>>& V) {
  Row<Dof>&row1 = rows[contact.normal + 1], &row2 = rows[contact.normal + 2];
  const double radius = contact.mu * rows[contact.normal].lambda;
  const Vec2 before(row1.lambda, row2.lambda);
  for (Row<Dof>* row : {&row1, &row2}) {
    row->lo = -infinity;
    row->hi = infinity;
    update_row(*row, V);
  }
  const Vec2 both(row1.lambda, row2.lambda), after = onto_disc(both, radius);
  apply_impulse(row1, after[0] - both[0], V);
  apply_impulse(row2, after[1] - both[1], V);
  row1.lambda = after[0];
  row2.lambda = after[1];
  return row1.diagonal * (after - before).norm();
}

template double update_friction<3>(const FrictionContact&, std::vector<Row<3>>&, std::vector<Twist<3>>&);
template double update_friction<6>(const FrictionContact&, std::vector<Row<6>>&, std::vector<Twist<6>>&);

}  // namespace spook
