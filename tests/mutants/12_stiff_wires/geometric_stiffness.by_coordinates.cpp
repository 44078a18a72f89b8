// Wrong: squares the direction coordinate by coordinate.
// Killed by: GeometricStiffness.IsHowThePullTurns
// Says: n turns with the distance of the ends
#include "12_stiff_wires/stiff_wires.hpp"

namespace spook {

Mat3 geometric_stiffness(const Vec3& n, double length, double tension) {
  if (tension <= 0) return Mat3::Zero();
  const Vec3 across = Vec3::Ones() - n.cwiseProduct(n);
  return tension / length * across.asDiagonal().toDenseMatrix();
}

}  // namespace spook
