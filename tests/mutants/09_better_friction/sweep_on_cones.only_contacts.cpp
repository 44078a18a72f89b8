// Wrong: sweeps the contacts and leaves the joints out.
// Killed by: SweepOnCones.TakesEveryRowInOrderAndTheFrictionOfAContactTogether
// Says: joints are swept, too
#include <cmath>

#include "09_better_friction/better_friction.hpp"

namespace spook {

template <int Dof>
double sweep_on_cones(const std::vector<Rubbing>& contacts, std::vector<Row<Dof>>& rows,
                      std::vector<Twist<Dof>>& V) {
  double largest = 0;
  const auto note = [&](double lacked) {
    if (std::isnan(lacked) || lacked > largest) largest = lacked;
  };
  for (const Rubbing& contact : contacts) {
    note(rows[contact.normal].diagonal * std::abs(update_row(rows[contact.normal], V)));
    note(update_friction(contact, rows, V));
  }
  return largest;
}

template double sweep_on_cones<3>(const std::vector<Rubbing>&, std::vector<Row<3>>&, std::vector<Twist<3>>&);
template double sweep_on_cones<6>(const std::vector<Rubbing>&, std::vector<Row<6>>&, std::vector<Twist<6>>&);

}  // namespace spook
