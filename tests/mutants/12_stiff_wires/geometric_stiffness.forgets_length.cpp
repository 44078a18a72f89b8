// Wrong: leaves the length out.
// Killed by: GeometricStiffness.ByHand
// Says: The length is missing
#include "12_stiff_wires/stiff_wires.hpp"

namespace spook {

Mat3 geometric_stiffness(const Vec3& n, double length, double tension) {
  if (tension <= 0) return Mat3::Zero();
  return tension * (Mat3::Identity() - n * n.transpose()) + 0 * length * Mat3::Identity();
}

}  // namespace spook
