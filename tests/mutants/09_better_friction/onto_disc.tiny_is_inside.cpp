// Wrong: leaves what is small where it is.
// Killed by: OntoDisc.HasNoSizeOfItsOwn
// Says: So small an impulse has been left outside
#include "09_better_friction/better_friction.hpp"

namespace spook {

Vec2 onto_disc(const Vec2& lambda, double radius) {
  const double length = lambda.norm();
  if (length <= radius + 1e-12) return lambda;
  return radius / length * lambda;  // Eq. (9.4)
}

}  // namespace spook
