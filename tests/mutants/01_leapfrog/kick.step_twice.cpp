// Wrong: has h once too often, as in the formula for a position under constant force.
// Killed by: Kick.AddsForceOverMassTimesStep
// Says: one h too many
#include "01_leapfrog/leapfrog.hpp"

namespace spook {

Vec3 kick(const Vec3& v, const Vec3& f, double inverse_mass, double h) {
  return v + h * h * inverse_mass * f;
}

}  // namespace spook
