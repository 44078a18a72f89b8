// Wrong: goes back a whole step.
// Killed by: HalfStepStart.GoesBackHalfAStep
// Says: a whole step back
#include "01_leapfrog/leapfrog.hpp"

namespace spook {

Vec3 half_step_start(const Vec3& v, const Vec3& f, double inverse_mass, double h) {
  return v - h * inverse_mass * f;
}

}  // namespace spook
