// Wrong: takes centres within a micrometre of each other for one place.
// Killed by: BallBall.FollowsCentresThatAreNear
// Says: However near, n is along x_j - x_i
#include "08_pairs/pairs.hpp"

namespace spook {

std::optional<Contact> ball_ball(const Ball& i, const Ball& j) {
  const Vec3 apart = j.x - i.x;
  const double distance = apart.norm();
  const double gap = distance - i.radius - j.radius;  // Eq. (8.2)
  if (!(gap <= 0)) return std::nullopt;
  const Vec3 n = distance > 1e-6 ? Vec3(apart / distance) : Vec3::UnitZ();
  const Vec3 r_i = (i.radius + gap / 2) * n;  // to the middle of the overlap
  return Contact{.i = i.body, .j = j.body, .n = n, .gap = gap, .r_i = r_i, .r_j = r_i - apart};  // Eq. (8.3)
}

}  // namespace spook
