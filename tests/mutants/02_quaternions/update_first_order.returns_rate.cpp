// Wrong: returns the step alone, normalised.
// Killed by: UpdateFirstOrder.TurnsByTwiceTheArcTangent
// Says: This is the rate alone
#include "02_quaternions/quaternions.hpp"

namespace spook {

Quat update_first_order(const Quat& q, const Vec3& omega, double h) {
  Quat step = quaternion_rate(q, omega);
  step.coeffs() *= h;
  return step.normalized();
}

}  // namespace spook
