// Wrong: takes every wire to hang.
// Killed by: GeometricStiffness.LeavesTheLinksOwnDirectionAlone
// Says: Along itself the link is held by its row
#include "12_stiff_wires/stiff_wires.hpp"

namespace spook {

Mat3 geometric_stiffness(const Vec3& n, double length, double tension) {
  if (tension <= 0) return Mat3::Zero();
  (void)n;
  return tension / length * Vec3(1, 1, 0).asDiagonal().toDenseMatrix();
}

}  // namespace spook
