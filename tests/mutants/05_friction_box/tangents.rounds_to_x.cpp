// Wrong: takes a normal for x when n_x is 1, to which it rounds beside x, too.
// Killed by: Tangents.HoldAtAndNearEveryAxis
// Says: This tangent is an axis itself
#include <cmath>

#include "05_friction_box/friction_box.hpp"

namespace spook {

Tangents tangents(const Vec3& n) {
  const bool is_x = std::abs(n.x()) == 1;
  const Vec3 t1 = is_x ? Vec3::UnitY() : Vec3(n.cross(Vec3::UnitX()).normalized());
  return {t1, n.cross(t1)};  // Eq. (5.1)
}

}  // namespace spook
