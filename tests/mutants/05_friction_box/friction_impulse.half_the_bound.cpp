// Wrong: has an interval as wide as Λ.
// Killed by: FrictionImpulse.KeepsItsBoundBothWays
// Says: Half of the bound
#include <algorithm>

#include "05_friction_box/friction_box.hpp"

namespace spook {

Vec3 friction_impulse(const Mat3& K, const Vec3& u, const Tangents& tangents, double Gamma, double bound) {
  const auto along = [&](const Vec3& t) -> Vec3 {
    const double lambda = -u.dot(t) / (t.dot(K * t) + Gamma);  // Eq. (5.3)
    return std::clamp(lambda, -bound / 2, bound / 2) * t;
  };
  return along(tangents.t1) + along(tangents.t2);
}

}  // namespace spook
