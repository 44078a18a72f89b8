// Wrong: lets the body turn about an ω that never changes.
// Killed by: FreeRotation.StandsOnItsHeadAfterHalfAPeriodAndReturns
// Says: With a constant ω it never does
#include "02_quaternions/quaternions.hpp"

namespace spook {

void free_rotation(Quat& q, Vec3& omega, const Vec3& principal, double h) {
  (void)principal;
  q = update_exponential(q, omega, h);
}

}  // namespace spook
