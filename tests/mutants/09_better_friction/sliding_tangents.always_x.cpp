// Wrong: takes x for a tangent wherever nothing slides.
// Killed by: SlidingTangents.TakeAnyWhereNothingSlides
// Says: take chapter 05's tangents
#include "09_better_friction/better_friction.hpp"

namespace spook {

Tangents sliding_tangents(const Vec3& n, const Vec3& u, double slow) {
  const Vec3 slip = u - n.dot(u) * n;
  const double speed = slip.norm();
  if (!(speed > slow)) return {.t1 = Vec3::UnitX(), .t2 = n.cross(Vec3::UnitX())};
  // Once more across n, for what roundings left along it.
  const Vec3 t1 = (slip / speed - n.dot(slip / speed) * n).normalized();
  return {.t1 = t1, .t2 = n.cross(t1)};
}

}  // namespace spook
