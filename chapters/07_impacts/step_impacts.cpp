#include "07_impacts/impacts.hpp"
#include "common/not_implemented.hpp"
#include "common/require.hpp"

namespace spook {

SolveReport step_impacts(Simulation& simulation, const std::vector<Contact>& contacts, double h) {
  // Eq. (7.1)-(7.10) on the velocities of t_n - h/2, then step_joints; see impacts.hpp.
  not_implemented("7.9 step_impacts", simulation, contacts, h);
}

}  // namespace spook
