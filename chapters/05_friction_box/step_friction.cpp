#include "05_friction_box/friction_box.hpp"
#include "common/not_implemented.hpp"

namespace spook {

SolveReport step_friction(Simulation& simulation, const std::vector<Contact>& contacts, double h) {
  // Begin with a copy of your step_contacts, and add Eq. (5.3)-(5.8); see friction_box.hpp.
  not_implemented("5.7 step_friction", simulation, contacts, h);
}

}  // namespace spook
