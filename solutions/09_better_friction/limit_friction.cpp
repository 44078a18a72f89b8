#include "09_better_friction/better_friction.hpp"

namespace spook {

template <int Dof>
void limit_friction(const std::vector<FrictionContact>& contacts, std::vector<Row<Dof>>& rows) {
  for (const FrictionContact& contact : contacts) {
    const double limit = contact.mu * rows[contact.normal].lambda;  // Eq. (9.1)
    for (const std::size_t k : {contact.normal + 1, contact.normal + 2}) {
      rows[k].lo = -limit;
      rows[k].hi = limit;
    }
  }
}

template void limit_friction<3>(const std::vector<FrictionContact>&, std::vector<Row<3>>&);
template void limit_friction<6>(const std::vector<FrictionContact>&, std::vector<Row<6>>&);

}  // namespace spook
