// Wrong: keeps L and turns by ω of the start of the step: the period is of first order.
// Killed by: FreeRotation.HasTheTopsPeriod
// Says: the period shows the smallest mistake
#include "02_quaternions/quaternions.hpp"

namespace spook {

void free_rotation(Quat& q, Vec3& omega, const Vec3& principal, double h) {
  const Vec3 L = world_inertia(q, principal) * omega;
  q = update_exponential(q, omega, h);
  omega = world_inertia(q, principal.cwiseInverse()) * L;
}

}  // namespace spook
