// Wrong: crosses n with a skew vector, in the hope that no contact is along it.
// Killed by: Tangents.HaveNoDirectionAtWhichTheyBreak
// Says: it is along this n
#include "05_friction_box/friction_box.hpp"

namespace spook {

Tangents tangents(const Vec3& n) {
  const Vec3 t1 = n.cross(Vec3(3, 4, 12) / 13).normalized();
  return {t1, n.cross(t1)};
}

}  // namespace spook
