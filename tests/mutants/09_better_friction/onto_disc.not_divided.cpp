// Wrong: multiplies by the radius and does not divide by the length.
// Killed by: OntoDisc.ShortensWhatIsOutside
// Says: divide by |λ_t|, too
#include "09_better_friction/better_friction.hpp"

namespace spook {

Vec2 onto_disc(const Vec2& lambda, double radius) {
  const double length = lambda.norm();
  if (length <= radius) return lambda;
  return radius * lambda;  // Eq. (9.4)
}

}  // namespace spook
