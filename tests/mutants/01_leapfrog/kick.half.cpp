// Wrong: kicks for half a step, every step.
// Killed by: Kick.AddsForceOverMassTimesStep
// Says: Only the start of a simulation takes half a step
#include "01_leapfrog/leapfrog.hpp"

namespace spook {

Vec3 kick(const Vec3& v, const Vec3& f, double inverse_mass, double h) {
  return v + h / 2 * inverse_mass * f;
}

}  // namespace spook
