#include "13_mechanisms/mechanisms.hpp"

namespace spook {

Coordinate shift_along(const JointFrame& i, const JointFrame& j, int axis) {
  const Vec3 n = i.axes * Vec3::Unit(axis);
  const Vec3 d = (j.at.x + j.at.r) - (i.at.x + i.at.r);
  Coordinate shift{.i = i.at.body, .j = j.at.body, .Gi = {}, .Gj = {}, .value = n.dot(d)};  // Eq. (13.5)
  shift.Gi << -n, -(i.at.r + d).cross(n);                                                   // Eq. (13.6)
  shift.Gj << n, j.at.r.cross(n);
  return shift;
}

}  // namespace spook
