// Wrong: is stiff along the link.
// Killed by: GeometricStiffness.IsHowThePullTurns
// Says: This is along the link
#include "12_stiff_wires/stiff_wires.hpp"

namespace spook {

Mat3 geometric_stiffness(const Vec3& n, double length, double tension) {
  if (tension <= 0) return Mat3::Zero();
  return tension / length * n * n.transpose();
}

}  // namespace spook
