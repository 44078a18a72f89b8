#include "09_better_friction/better_friction.hpp"

namespace spook {

Vec2 onto_disc(const Vec2& lambda, double radius) {
  const double length = lambda.norm();
  if (length <= radius) return lambda;
  return radius / length * lambda;  // Eq. (9.4)
}

}  // namespace spook
