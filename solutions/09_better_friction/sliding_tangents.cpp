#include "09_better_friction/better_friction.hpp"

namespace spook {

Tangents sliding_tangents(const Vec3& n, const Vec3& u, double slow) {
  const Vec3 slip = u - n.dot(u) * n;
  const double speed = slip.norm();
  if (!(speed > slow)) return tangents(n);
  // Projects across n once more, since round-off leaves a part along it.
  const Vec3 t1 = (slip / speed - n.dot(slip / speed) * n).normalized();
  return {.t1 = t1, .t2 = n.cross(t1)};
}

}  // namespace spook
