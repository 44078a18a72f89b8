// Wrong: leaves out a ball that just touches.
// Killed by: PlaneBall.TouchesFromZeroGapOn
// Says: exactly zero counts
#include "08_pairs/pairs.hpp"

namespace spook {

std::optional<Contact> plane_ball(const Plane& plane, const Ball& ball) {
  const double gap = plane.n.dot(ball.x) - plane.offset - ball.radius;  // Eq. (8.1)
  if (!(gap < 0)) return std::nullopt;
  const Vec3 p = ball.x - ball.radius * plane.n;
  return Contact{.i = plane.body,
                 .j = ball.body,
                 .n = plane.n,
                 .gap = gap,
                 .r_i = p - plane.x,  // Eq. (8.3)
                 .r_j = p - ball.x};
}

}  // namespace spook
