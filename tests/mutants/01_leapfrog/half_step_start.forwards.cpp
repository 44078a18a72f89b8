// Wrong: goes half a step forwards, so that the first kick comes on top of it.
// Killed by: HalfStepStart.GoesBackHalfAStep
// Says: half a step forwards
#include "01_leapfrog/leapfrog.hpp"

namespace spook {

Vec3 half_step_start(const Vec3& v, const Vec3& f, double inverse_mass, double h) {
  return v + h / 2 * inverse_mass * f;
}

}  // namespace spook
