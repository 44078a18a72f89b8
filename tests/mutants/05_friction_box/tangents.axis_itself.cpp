// Wrong: takes the axis farthest from n for a tangent.
// Killed by: Tangents.ArePerpendicularToTheNormalAndToEachOther
// Says: It leaves the plane of contact
#include "05_friction_box/friction_box.hpp"

namespace spook {

Tangents tangents(const Vec3& n) {
  int axis;
  n.cwiseAbs().minCoeff(&axis);
  const Vec3 t1 = Vec3::Unit(axis);
  return {t1, n.cross(t1).normalized()};
}

}  // namespace spook
