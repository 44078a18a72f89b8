#pragma once
// The energy of a run, half a step before the positions.
#include "engine/bodies/conserved_quantities.hpp"

namespace spook {

/// Kinetic energy plus energy of the weight, at the time half a step ago [J]: v belongs to that time, and x - h v/2 is
/// the midpoint of the last two positions. The energy is zero at rest at the height of the origin.
template <int Dof>
double half_step_energy(const Bodies<Dof>& bodies, double g, double h) {
  double energy = kinetic_energy(bodies);
  for (std::size_t i = 0; i < bodies.size(); ++i)
    energy += bodies.mass[i] * g * (bodies.x[i].z() - h * bodies.motion.W[i].z() / 2);
  return energy;
}

}  // namespace spook
