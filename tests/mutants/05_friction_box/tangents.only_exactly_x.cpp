// Wrong: crosses n with x unless n is x itself: next to it the product is too small to be normalised.
// Killed by: Tangents.HoldAtAndNearEveryAxis
// Says: The square of 1e-160 underflows
#include "05_friction_box/friction_box.hpp"

namespace spook {

Tangents tangents(const Vec3& n) {
  const bool is_x = n.cwiseAbs() == Vec3::UnitX();
  const Vec3 t1 = n.cross(is_x ? Vec3::UnitY() : Vec3::UnitX()).normalized();
  return {t1, n.cross(t1)};
}

}  // namespace spook
