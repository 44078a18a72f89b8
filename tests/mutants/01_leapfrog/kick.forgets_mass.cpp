// Wrong: adds the force as if it were an acceleration.
// Killed by: Kick.AddsForceOverMassTimesStep
// Says: has not been divided by the mass
#include "01_leapfrog/leapfrog.hpp"

namespace spook {

Vec3 kick(const Vec3& v, const Vec3& f, double inverse_mass, double h) {
  (void)inverse_mass;
  return v + h * f;
}

}  // namespace spook
