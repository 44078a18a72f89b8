// Wrong: makes a slack link of a NaN.
// Killed by: GeometricStiffness.KeepsANaN
// Says: the NaN has become a slack link
#include "12_stiff_wires/stiff_wires.hpp"

namespace spook {

Mat3 geometric_stiffness(const Vec3& n, double length, double tension) {
  if (!(tension > 0)) return Mat3::Zero();
  return tension / length * (Mat3::Identity() - n * n.transpose());  // Eq. (12.3)
}

}  // namespace spook
