#include <cmath>

#include "08_pairs/pairs.hpp"

namespace spook {

std::optional<Contact> box_ball(const Box& box, const Ball& ball) {
  // Along the axes of the box its nearest point is the centre of the ball, cut off at the half sides.
  const Vec3& h = box.half_sides;
  const Vec3 centre = box.axes.transpose() * (ball.x - box.x);
  Vec3 c = centre.cwiseMax(-h).cwiseMin(h), n = centre - c;
  double distance = n.norm();
  if (distance > 0) {
    n /= distance;
  } else {
    int axis;
    distance = -(h - centre.cwiseAbs()).minCoeff<Eigen::PropagateNaN>(&axis);
    n = std::copysign(1, centre[axis]) * Vec3::Unit(axis);
    c = centre - distance * n;
  }
  const double gap = distance - ball.radius;  // Eq. (8.5)
  if (!(gap <= 0)) return std::nullopt;
  const Vec3 r = box.axes * (c + gap / 2 * n);
  return Contact{.i = box.body,
                 .j = ball.body,
                 .n = box.axes * n,
                 .gap = gap,
                 .r_i = r,
                 .r_j = r - (ball.x - box.x)};  // Eq. (8.3)
}

}  // namespace spook
