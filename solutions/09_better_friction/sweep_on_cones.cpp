#include <cmath>

#include "09_better_friction/better_friction.hpp"

namespace spook {

template <int Dof>
double sweep_on_cones(const std::vector<FrictionContact>& contacts, std::vector<Row<Dof>>& rows,
                      std::vector<Twist<Dof>>& V) {
  double largest = 0;
  const auto note = [&](double lacked) {
    if (std::isnan(lacked) || lacked > largest) largest = lacked;
  };
  auto contact = contacts.begin();
  for (std::size_t k = 0; k < rows.size(); ++k) {
    note(rows[k].diagonal * std::abs(update_row(rows[k], V)));
    if (contact == contacts.end() || contact->normal != k) continue;
    note(update_friction(*contact++, rows, V));
    k += 2;
  }
  return largest;
}

template double sweep_on_cones<3>(const std::vector<FrictionContact>&, std::vector<Row<3>>&,
                                  std::vector<Twist<3>>&);
template double sweep_on_cones<6>(const std::vector<FrictionContact>&, std::vector<Row<6>>&,
                                  std::vector<Twist<6>>&);

}  // namespace spook
