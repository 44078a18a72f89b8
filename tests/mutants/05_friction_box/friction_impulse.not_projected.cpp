// Wrong: leaves the bound out.
// Killed by: FrictionImpulse.KeepsItsBoundBothWays
// Says: The bound has not been kept
#include "05_friction_box/friction_box.hpp"

namespace spook {

Vec3 friction_impulse(const Mat3& K, const Vec3& u, const Tangents& tangents, double Gamma, double) {
  const auto along = [&](const Vec3& t) -> Vec3 {
    const double lambda = -u.dot(t) / (t.dot(K * t) + Gamma);
    return lambda * t;
  };
  return along(tangents.t1) + along(tangents.t2);
}

}  // namespace spook
