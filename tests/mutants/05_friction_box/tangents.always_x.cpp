// Wrong: crosses n with x, whatever n is.
// Killed by: Tangents.HoldAtAndNearEveryAxis
// Says: n has been crossed with itself
#include "05_friction_box/friction_box.hpp"

namespace spook {

Tangents tangents(const Vec3& n) {
  const Vec3 t1 = n.cross(Vec3::UnitX()).normalized();
  return {t1, n.cross(t1)};
}

}  // namespace spook
