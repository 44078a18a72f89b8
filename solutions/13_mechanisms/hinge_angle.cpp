#include <cmath>
#include <numbers>

#include "13_mechanisms/mechanisms.hpp"

namespace spook {

Coordinate hinge_angle(const JointFrame& i, const JointFrame& j, double last) {
  const Quat Q = i.axes.conjugate() * j.axes;
  const double angle = 2 * std::atan2(Q.z(), Q.w()), turn = 2 * std::numbers::pi;  // Eq. (13.8)
  Twist<6> G = Twist<6>::Zero();
  G.tail<3>() = i.axes * Vec3::UnitZ();
  return {.i = i.at.body,
          .j = j.at.body,
          .Gi = -G,
          .Gj = G,
          .value = angle - turn * std::round((angle - last) / turn)};  // Eq. (13.9)
}

}  // namespace spook
