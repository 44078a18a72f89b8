// Wrong: leaves the cross product as long as it is.
// Killed by: Tangents.AreUnitVectors
// Says: as long as the sine of the angle between its factors
#include "05_friction_box/friction_box.hpp"

namespace spook {

Tangents tangents(const Vec3& n) {
  int axis;
  n.cwiseAbs().minCoeff(&axis);
  const Vec3 t1 = n.cross(Vec3::Unit(axis));
  return {t1, n.cross(t1)};
}

}  // namespace spook
