#include "05_friction_box/friction_box.hpp"

namespace spook {

Tangents tangents(const Vec3& n) {
  // The axis farthest from n: the sine of the angle between them is at least √(2/3), so nothing is lost by normalising.
  int axis;
  n.cwiseAbs().minCoeff(&axis);
  const Vec3 t1 = n.cross(Vec3::Unit(axis)).normalized();
  return {t1, n.cross(t1)};  // Eq. (5.1)
}

}  // namespace spook
