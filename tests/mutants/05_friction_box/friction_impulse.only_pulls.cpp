// Wrong: projects on [-Λ, 0].
// Killed by: FrictionImpulse.KeepsItsBoundBothWays
// Says: λ has been kept between -Λ and 0
#include <algorithm>

#include "05_friction_box/friction_box.hpp"

namespace spook {

Vec3 friction_impulse(const Mat3& K, const Vec3& u, const Tangents& tangents, double Gamma, double bound) {
  const auto along = [&](const Vec3& t) -> Vec3 {
    const double lambda = -u.dot(t) / (t.dot(K * t) + Gamma);  // Eq. (5.3)
    return std::clamp(lambda, -bound, 0.0) * t;
  };
  return along(tangents.t1) + along(tangents.t2);
}

}  // namespace spook
