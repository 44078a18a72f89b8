// Wrong: crosses t1 with n instead of n with t1.
// Killed by: Tangents.AreRightHanded
// Says: the tangents are left-handed
#include "05_friction_box/friction_box.hpp"

namespace spook {

Tangents tangents(const Vec3& n) {
  int axis;
  n.cwiseAbs().minCoeff(&axis);
  const Vec3 t1 = n.cross(Vec3::Unit(axis)).normalized();
  return {t1, t1.cross(n)};
}

}  // namespace spook
