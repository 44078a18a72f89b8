// Wrong: takes the direction of all of u.
// Killed by: SlidingTangents.FollowTheSlipByHand
// Says: What u has along n is no slip
#include "09_better_friction/better_friction.hpp"

namespace spook {

Tangents sliding_tangents(const Vec3& n, const Vec3& u, double slow) {
  const Vec3 slip = u;
  const double speed = slip.norm();
  if (!(speed > slow)) return tangents(n);
  // Once more across n, for what roundings left along it.
  const Vec3 t1 = (slip / speed).normalized();
  return {.t1 = t1, .t2 = n.cross(t1)};
}

}  // namespace spook
