// Wrong: has the sign of the force.
// Killed by: GeometricStiffness.ByHand
// Says: The sign: K pulls a turned link back
#include "12_stiff_wires/stiff_wires.hpp"

namespace spook {

Mat3 geometric_stiffness(const Vec3& n, double length, double tension) {
  if (tension <= 0) return Mat3::Zero();
  return tension / length * (n * n.transpose() - Mat3::Identity());
}

}  // namespace spook
