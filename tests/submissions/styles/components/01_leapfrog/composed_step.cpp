#include <cmath>
#include <stdexcept>
#include <string>

#include "01_leapfrog/leapfrog.hpp"

namespace spook {

static void one_part(Particles& bodies, const ForceField& force, double h) {
  const std::size_t count = bodies.x.size();
  for (std::size_t i = 0; i < count; ++i)
    for (int axis = 0; axis < 3; ++axis) bodies.x[i][axis] += 0.5 * h * bodies.v[i][axis];
  std::vector<Vec3> forces(count);
  for (std::size_t i = 0; i < count; ++i) forces[i] = force(i, bodies.x);
  for (std::size_t i = 0; i < count; ++i) {
    bodies.v[i] = kick(bodies.v[i], forces[i], bodies.inverse_mass[i], h);
    for (int axis = 0; axis < 3; ++axis) bodies.x[i][axis] += 0.5 * h * bodies.v[i][axis];
  }
}

void composed_step(Particles& bodies, const ForceField& force, double h, int pairs) {
  if (!(h > 0) || std::isinf(h))
    throw std::invalid_argument("h must be positive and finite, but is " + std::to_string(h));
  if (pairs < 1) throw std::invalid_argument("pairs must be at least 1, but is " + std::to_string(pairs));
  const double twice = 2.0 * pairs;
  const double outer = h / (twice - std::pow(twice, 1.0 / 3.0));
  for (int n = 0; n < pairs; ++n) one_part(bodies, force, outer);
  one_part(bodies, force, h - twice * outer);
  for (int n = 0; n < pairs; ++n) one_part(bodies, force, outer);
}

}  // namespace spook
