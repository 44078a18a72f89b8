// Wrong: keeps each component in ±radius.
// Killed by: OntoDisc.ShortensWhatIsOutside
// Says: This is the box
#include "09_better_friction/better_friction.hpp"

namespace spook {

Vec2 onto_disc(const Vec2& lambda, double radius) {
  return lambda.cwiseMax(-radius).cwiseMin(radius);
}

}  // namespace spook
