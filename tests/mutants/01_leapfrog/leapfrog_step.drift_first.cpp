// Wrong: moves first with the old velocity, then kicks with the new positions: reversible, but of another phase.
// Killed by: LeapfrogStep.FallsByTheExactDiscreteLaw
// Says: drifts with the old velocity
#include "01_leapfrog/leapfrog.hpp"
#include "common/require.hpp"

namespace spook {

void leapfrog_step(Particles& bodies, const ForceField& force, double h) {
  require_positive("h", h);
  for (std::size_t i = 0; i < bodies.x.size(); ++i) bodies.x[i] = drift(bodies.x[i], bodies.v[i], h);
  for (std::size_t i = 0; i < bodies.x.size(); ++i)
    bodies.v[i] = kick(bodies.v[i], force(i, bodies.x), bodies.inverse_mass[i], h);
}

}  // namespace spook
