// Wrong: returns before it has looked at K and Γ where u = 0.
// Killed by: FrictionImpulse.KeepsANaN
// Says: At rest, too
#include <algorithm>

#include "05_friction_box/friction_box.hpp"

namespace spook {

Vec3 friction_impulse(const Mat3& K, const Vec3& u, const Tangents& tangents, double Gamma, double bound) {
  if (u.isZero(0)) return Vec3::Zero();
  const auto along = [&](const Vec3& t) -> Vec3 {
    const double lambda = -u.dot(t) / (t.dot(K * t) + Gamma);  // Eq. (5.3)
    return std::clamp(lambda, -bound, bound) * t;              // Eq. (5.8)
  };
  return along(tangents.t1) + along(tangents.t2);
}

}  // namespace spook
