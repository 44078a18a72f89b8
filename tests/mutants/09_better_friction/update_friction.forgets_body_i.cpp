// Wrong: has only body j's part of S12.
// Killed by: UpdateFriction.CountsBothBodies
// Says: that of i is missing
#include <cmath>

#include "09_better_friction/cone_rows.hpp"

namespace spook {

template <int Dof>
double update_friction(const Rubbing& contact, std::vector<Row<Dof>>& rows, std::vector<Twist<Dof>>& V) {
  Row<Dof>&row1 = rows[contact.normal + 1], &row2 = rows[contact.normal + 2];
  const double S12 = row1.Gj.dot(row2.MinvGj);
  const double s = (row1.diagonal + row2.diagonal) / 2 + std::hypot((row1.diagonal - row2.diagonal) / 2, S12);
  const Vec2 before(row1.lambda, row2.lambda), after = next_friction(contact, rows, V, s),
                                               change = after - before;
  row1.lambda = after[0];
  row2.lambda = after[1];
  apply_impulse(row1, change[0], V);
  apply_impulse(row2, change[1], V);
  return s * change.norm();
}

template double update_friction<3>(const Rubbing&, std::vector<Row<3>>&, std::vector<Twist<3>>&);
template double update_friction<6>(const Rubbing&, std::vector<Row<6>>&, std::vector<Twist<6>>&);

}  // namespace spook
