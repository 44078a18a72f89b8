// Wrong: projects with std::min, which makes a bound of a NaN.
// Killed by: FrictionImpulse.KeepsANaN
// Says: made a number of it
#include <algorithm>

#include "05_friction_box/friction_box.hpp"

namespace spook {

Vec3 friction_impulse(const Mat3& K, const Vec3& u, const Tangents& tangents, double Gamma, double bound) {
  const auto along = [&](const Vec3& t) -> Vec3 {
    const double lambda = -u.dot(t) / (t.dot(K * t) + Gamma);
    return std::max(-bound, std::min(bound, lambda)) * t;
  };
  return along(tangents.t1) + along(tangents.t2);
}

}  // namespace spook
