// Wrong: divides by n·Kn.
// Killed by: FrictionImpulse.SolvesBothRowsByHand
// Says: This has n·Kn in it
#include <algorithm>

#include "05_friction_box/friction_box.hpp"

namespace spook {

Vec3 friction_impulse(const Mat3& K, const Vec3& u, const Tangents& tangents, double Gamma, double bound) {
  const Vec3 n = tangents.t1.cross(tangents.t2);
  const auto along = [&](const Vec3& t) -> Vec3 {
    const double lambda = -u.dot(t) / (n.dot(K * n) + Gamma);
    return std::clamp(lambda, -bound, bound) * t;
  };
  return along(tangents.t1) + along(tangents.t2);
}

}  // namespace spook
