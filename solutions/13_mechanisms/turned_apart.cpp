#include "13_mechanisms/mechanisms.hpp"

namespace spook {

std::array<Coordinate, 3> turned_apart(const JointFrame& i, const JointFrame& j) {
  const Quat Q = i.axes.conjugate() * j.axes;  // Eq. (13.1)
  std::array<Coordinate, 3> apart;
  for (int axis = 0; axis < 3; ++axis) {
    const Vec3 e = Vec3::Unit(axis);
    Twist<6> G = Twist<6>::Zero();
    G.tail<3>() = i.axes * (Q.w() * e + Q.vec().cross(e));  // Eq. (13.4)
    apart[static_cast<std::size_t>(axis)] = {
        .i = i.at.body, .j = j.at.body, .Gi = -G, .Gj = G, .value = 2 * Q.vec()[axis]};  // Eq. (13.3)
  }
  return apart;
}

}  // namespace spook
