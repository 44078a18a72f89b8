// Wrong: takes the size of the tension.
// Killed by: GeometricStiffness.OfALinkThatPushesIsZero
// Says: not |T|, but none
#include "12_stiff_wires/stiff_wires.hpp"

namespace spook {

Mat3 geometric_stiffness(const Vec3& n, double length, double tension) {
  return std::abs(tension) / length * (Mat3::Identity() - n * n.transpose());  // Eq. (12.3)
}

}  // namespace spook
