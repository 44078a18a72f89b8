// Wrong: is stiff in all directions.
// Killed by: GeometricStiffness.IsHowThePullTurns
// Says: This is T/l in all directions
#include "12_stiff_wires/stiff_wires.hpp"

namespace spook {

Mat3 geometric_stiffness(const Vec3& n, double length, double tension) {
  if (tension <= 0) return Mat3::Zero();
  return tension / length * Mat3::Identity() + 0 * n * n.transpose();
}

}  // namespace spook
