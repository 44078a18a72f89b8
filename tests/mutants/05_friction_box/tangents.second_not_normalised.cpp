// Wrong: normalises t1 only after t2 has been made of it.
// Killed by: Tangents.AreUnitVectors
// Says: normalise t1 first
#include "05_friction_box/friction_box.hpp"

namespace spook {

Tangents tangents(const Vec3& n) {
  int axis;
  n.cwiseAbs().minCoeff(&axis);
  const Vec3 t1 = n.cross(Vec3::Unit(axis));
  return {t1.normalized(), n.cross(t1)};
}

}  // namespace spook
