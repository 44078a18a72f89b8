// Wrong: takes any step, also one that is not a number.
// Killed by: LeapfrogStep.RejectsAStepThatIsNotPositive
// Says: nothing was thrown
#include "01_leapfrog/leapfrog.hpp"

namespace spook {

void leapfrog_step(Particles& bodies, const ForceField& force, double h) {
  for (std::size_t i = 0; i < bodies.x.size(); ++i)
    bodies.v[i] = kick(bodies.v[i], force(i, bodies.x), bodies.inverse_mass[i], h);
  for (std::size_t i = 0; i < bodies.x.size(); ++i) bodies.x[i] = drift(bodies.x[i], bodies.v[i], h);
}

}  // namespace spook
