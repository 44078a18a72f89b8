// Wrong: finds no axis where the two smallest coefficients of n are equally small.
// Killed by: Tangents.HoldWhereCoefficientsAreEqual
// Says: n has been crossed with itself
#include "05_friction_box/friction_box.hpp"

namespace spook {

Tangents tangents(const Vec3& n) {
  const Vec3 size = n.cwiseAbs();
  Vec3 axis = n;
  if (size.x() < size.y() && size.x() < size.z()) axis = Vec3::UnitX();
  if (size.y() < size.x() && size.y() < size.z()) axis = Vec3::UnitY();
  if (size.z() < size.x() && size.z() < size.y()) axis = Vec3::UnitZ();
  const Vec3 t1 = n.cross(axis).normalized();
  return {t1, n.cross(t1)};
}

}  // namespace spook
