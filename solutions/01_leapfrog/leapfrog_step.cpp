#include "01_leapfrog/leapfrog.hpp"
#include "common/require.hpp"

namespace spook {

void leapfrog_step(Particles& bodies, const ForceField& force, double h) {
  require_positive("h", h);
  // Two loops: a body that drifted early would be felt at its new position by the bodies after it.
  for (std::size_t i = 0; i < bodies.x.size(); ++i)
    bodies.v[i] = kick(bodies.v[i], force(i, bodies.x), bodies.inverse_mass[i], h);  // Eq. (1.3)
  for (std::size_t i = 0; i < bodies.x.size(); ++i)
    bodies.x[i] = drift(bodies.x[i], bodies.v[i], h);  // Eq. (1.4)
}

}  // namespace spook
