#include "07_impacts/impacts.hpp"
#include "common/require.hpp"

namespace spook {

SolveReport step_impacts(Simulation& simulation, const std::vector<Contact>& contacts, double h) {
  require_positive("h", h);
  if (simulation.restitution != 0) {
    Motion<6> motion = motion_of(simulation, h);
    resolve_impacts(contacts,
                    {.restitution = simulation.restitution,
                     .friction = simulation.mu,
                     .threshold = simulation.gravity.norm() * h},
                    motion);
    for (std::size_t b = 0; b < motion.W.size(); ++b) {
      simulation.bodies[b].v = motion.W[b].head<3>();
      simulation.bodies[b].omega = motion.W[b].tail<3>();
    }
  }
  return step_joints(simulation, contacts, h);
}

}  // namespace spook
