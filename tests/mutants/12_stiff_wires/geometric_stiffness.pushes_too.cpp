// Wrong: gives a link that pushes a negative K.
// Killed by: GeometricStiffness.OfALinkThatPushesIsZero
// Says: would turn away
#include "12_stiff_wires/stiff_wires.hpp"

namespace spook {

Mat3 geometric_stiffness(const Vec3& n, double length, double tension) {
  return tension / length * (Mat3::Identity() - n * n.transpose());  // Eq. (12.3)
}

}  // namespace spook
