// Wrong: multiplies by the length.
// Killed by: GeometricStiffness.ByHand
// Says: divide by the length
#include "12_stiff_wires/stiff_wires.hpp"

namespace spook {

Mat3 geometric_stiffness(const Vec3& n, double length, double tension) {
  if (tension <= 0) return Mat3::Zero();
  return tension * length * (Mat3::Identity() - n * n.transpose());
}

}  // namespace spook
