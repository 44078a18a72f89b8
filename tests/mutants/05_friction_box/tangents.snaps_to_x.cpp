// Wrong: takes a normal that is nearly x for x.
// Killed by: Tangents.HoldAtAndNearEveryAxis
// Says: This tangent is an axis itself
#include "05_friction_box/friction_box.hpp"

namespace spook {

Tangents tangents(const Vec3& n) {
  const Vec3 t1 = n.isApprox(Vec3::UnitX()) ? Vec3::UnitY() : n.cross(Vec3::UnitX()).normalized();
  return {t1, n.cross(t1)};  // Eq. (5.1)
}

}  // namespace spook
