// Wrong: makes a number of a length that is none.
// Killed by: OntoDisc.KeepsANaN
// Says: std::min and std::max drop a NaN
#include <cmath>

#include "09_better_friction/better_friction.hpp"

namespace spook {

Vec2 onto_disc(const Vec2& lambda, double radius) {
  const double length = lambda.norm();
  if (!(length > radius)) return std::isnan(length) ? Vec2(Vec2::Zero()) : lambda;
  return radius / length * lambda;  // Eq. (9.4)
}

}  // namespace spook
