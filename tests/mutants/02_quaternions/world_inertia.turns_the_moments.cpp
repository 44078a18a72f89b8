// Wrong: turns the three moments as if they were a vector.
// Killed by: WorldInertia.IsTheSumOverTheBodysAxes
// Says: were turned like a vector
#include "02_quaternions/quaternions.hpp"

namespace spook {

Mat3 world_inertia(const Quat& q, const Vec3& principal) {
  return (q * principal).asDiagonal();
}

}  // namespace spook
