// Wrong: kicks and drifts one body before it looks at the next.
// Killed by: LeapfrogStep.ComputesAllForcesAtOldPositions
// Says: Finish all kicks before the first drift
#include "01_leapfrog/leapfrog.hpp"
#include "common/require.hpp"

namespace spook {

void leapfrog_step(Particles& bodies, const ForceField& force, double h) {
  require_positive("h", h);
  for (std::size_t i = 0; i < bodies.x.size(); ++i) {
    bodies.v[i] = kick(bodies.v[i], force(i, bodies.x), bodies.inverse_mass[i], h);
    bodies.x[i] = drift(bodies.x[i], bodies.v[i], h);
  }
}

}  // namespace spook
