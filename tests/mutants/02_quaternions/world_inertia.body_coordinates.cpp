// Wrong: leaves the inertia in body coordinates.
// Killed by: WorldInertia.GivesTheSameEnergyInEveryFrame
// Says: The inertia is still in body coordinates
#include "02_quaternions/quaternions.hpp"

namespace spook {

Mat3 world_inertia(const Quat& q, const Vec3& principal) {
  (void)q;
  return principal.asDiagonal();
}

}  // namespace spook
