// Wrong: steps back as if every mass were 1 kg.
// Killed by: HalfStepStart.GoesBackHalfAStep
// Says: has not been divided by the mass
#include "01_leapfrog/leapfrog.hpp"

namespace spook {

Vec3 half_step_start(const Vec3& v, const Vec3& f, double inverse_mass, double h) {
  (void)inverse_mass;
  return v - h / 2 * f;
}

}  // namespace spook
