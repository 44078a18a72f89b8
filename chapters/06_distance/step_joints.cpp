#include "06_distance/distance.hpp"
#include "common/not_implemented.hpp"

namespace spook {

SolveReport step_joints(Simulation& simulation, const std::vector<Contact>& contacts, double h) {
  // Begin with a copy of your step_friction, and add Eq. (6.1)-(6.6); see distance.hpp.
  not_implemented("6.5 step_joints", simulation, contacts, h);
}

}  // namespace spook
