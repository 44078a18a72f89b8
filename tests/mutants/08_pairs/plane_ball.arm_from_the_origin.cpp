// Wrong: lets the arm of the plane's body begin at the origin.
// Killed by: PlaneBall.PressesIntoTheFloor
// Says: r_i is an arm
#include "08_pairs/pairs.hpp"

namespace spook {

std::optional<Contact> plane_ball(const Plane& plane, const Ball& ball) {
  const double gap = plane.n.dot(ball.x) - plane.offset - ball.radius;  // Eq. (8.1)
  if (!(gap <= 0)) return std::nullopt;
  const Vec3 p = ball.x - ball.radius * plane.n;
  return Contact{.i = plane.body,
                 .j = ball.body,
                 .n = plane.n,
                 .gap = gap,
                 .r_i = p,  // Eq. (8.3)
                 .r_j = p - ball.x};
}

}  // namespace spook
