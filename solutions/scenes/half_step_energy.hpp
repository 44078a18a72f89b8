#pragma once
// The energy of a run, at a time where both of its parts are known.
#include "engine/diagnostics/conserved_quantities.hpp"

namespace spook {

/// Kinetic energy and that of the weight, of the time half a step ago [J]: v is of that time, and x - h v/2 lies in
/// the middle between the last two positions. It is zero at rest at the height of the origin.
template <int Dof>
double half_step_energy(const Bodies<Dof>& bodies, double g, double h) {
  double energy = kinetic_energy(bodies);
  for (std::size_t i = 0; i < bodies.size(); ++i)
    energy += bodies.mass[i] * g * (bodies.x[i].z() - h * bodies.motion.W[i].z() / 2);
  return energy;
}

}  // namespace spook
