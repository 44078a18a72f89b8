// Wrong: drifts with the velocity of before the kick: explicit Euler.
// Killed by: LeapfrogStep.FallsByTheExactDiscreteLaw
// Says: This is explicit Euler
#include "01_leapfrog/leapfrog.hpp"
#include "common/require.hpp"

namespace spook {

void leapfrog_step(Particles& bodies, const ForceField& force, double h) {
  require_positive("h", h);
  const std::vector<Vec3> x = bodies.x;
  for (std::size_t i = 0; i < x.size(); ++i) bodies.x[i] = drift(x[i], bodies.v[i], h);
  for (std::size_t i = 0; i < x.size(); ++i)
    bodies.v[i] = kick(bodies.v[i], force(i, x), bodies.inverse_mass[i], h);
}

}  // namespace spook
