// Wrong: leaves the velocity where it is.
// Killed by: HalfStepStart.GivesOrderTwoOnAnOscillator
// Says: Order 1 means
#include "01_leapfrog/leapfrog.hpp"

namespace spook {

Vec3 half_step_start(const Vec3& v, const Vec3& f, double inverse_mass, double h) {
  (void)f, (void)inverse_mass, (void)h;
  return v;
}

}  // namespace spook
