// Wrong: leaves what is outside by a millionth.
// Killed by: OntoDisc.TakesInWhatIsJustOutside
// Says: has no slack of its own
#include "09_better_friction/better_friction.hpp"

namespace spook {

Vec2 onto_disc(const Vec2& lambda, double radius) {
  const double length = lambda.norm();
  if (length <= radius * (1 + 1e-6)) return lambda;
  return radius / length * lambda;  // Eq. (9.4)
}

}  // namespace spook
