#include "01_leapfrog/leapfrog.hpp"
#include "common/require.hpp"

namespace spook {

void leapfrog_step(Particles& bodies, const ForceField& force, double h) {
  require_positive("h", h);
  const auto old = bodies.x;
  for (std::size_t i = 0; i < old.size(); ++i)
    bodies.x[i] = drift(old[i], bodies.v[i] = kick(bodies.v[i], force(i, old), bodies.inverse_mass[i], h), h);
}

}  // namespace spook
