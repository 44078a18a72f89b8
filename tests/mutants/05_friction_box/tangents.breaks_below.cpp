// Wrong: takes the formula of Frisvad, which divides by 1 + n_z.
// Killed by: Tangents.HoldAtAndNearEveryAxis
// Says: n = (0, 0, -1), t1 = (NaN, NaN, 0)
#include "05_friction_box/friction_box.hpp"

namespace spook {

Tangents tangents(const Vec3& n) {
  const double a = 1 / (1 + n.z()), b = -n.x() * n.y() * a;
  return {Vec3(1 - n.x() * n.x() * a, b, -n.x()), Vec3(b, 1 - n.y() * n.y() * a, -n.y())};
}

}  // namespace spook
