// Wrong: leaves t2 out.
// Killed by: FrictionImpulse.SolvesBothRowsByHand
// Says: The row along t2 is missing
#include <algorithm>

#include "05_friction_box/friction_box.hpp"

namespace spook {

Vec3 friction_impulse(const Mat3& K, const Vec3& u, const Tangents& tangents, double Gamma, double bound) {
  const auto along = [&](const Vec3& t) -> Vec3 {
    const double lambda = -u.dot(t) / (t.dot(K * t) + Gamma);
    return std::clamp(lambda, -bound, bound) * t;
  };
  return along(tangents.t1);
}

}  // namespace spook
