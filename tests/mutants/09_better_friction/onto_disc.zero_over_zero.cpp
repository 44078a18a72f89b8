// Wrong: divides by the length of zero.
// Killed by: OntoDisc.IsNothingForNoRadius
// Says: 0 has no direction, and needs none
#include <algorithm>

#include "09_better_friction/better_friction.hpp"

namespace spook {

Vec2 onto_disc(const Vec2& lambda, double radius) {
  const double length = lambda.norm();
  return std::min(length, radius) / length * lambda;  // Eq. (9.4)
}

}  // namespace spook
