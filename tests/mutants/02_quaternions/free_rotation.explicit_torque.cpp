// Wrong: adds the gyroscopic torque explicitly: the top gains energy.
// Killed by: FreeRotation.KeepsEnergyInItsBandFor1e5Steps
// Says: adds energy in every step
#include "02_quaternions/quaternions.hpp"

namespace spook {

void free_rotation(Quat& q, Vec3& omega, const Vec3& principal, double h) {
  const Vec3 torque = gyroscopic_torque(world_inertia(q, principal), omega);
  omega += h * world_inertia(q, principal.cwiseInverse()) * torque;
  q = update_exponential(q, omega, h);
}

}  // namespace spook
