#include <cmath>
#include <stdexcept>
#include <string>

#include "01_leapfrog/leapfrog.hpp"

namespace spook {

void leapfrog_step(Particles& bodies, const ForceField& force, double h) {
  if (!(h > 0) || std::isinf(h))
    throw std::invalid_argument("h must be positive and finite, but is " + std::to_string(h));
  const std::size_t count = bodies.x.size();
  std::vector<Vec3> forces(count);
  for (std::size_t i = 0; i < count; ++i) forces[i] = force(i, bodies.x);
  for (std::size_t i = 0; i < count; ++i) {
    bodies.v[i] = kick(bodies.v[i], forces[i], bodies.inverse_mass[i], h);
    bodies.x[i] = drift(bodies.x[i], bodies.v[i], h);
  }
}

}  // namespace spook
