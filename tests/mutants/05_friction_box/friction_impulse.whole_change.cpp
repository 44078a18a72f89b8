// Wrong: divides by the length of Kt.
// Killed by: FrictionImpulse.DividesByWhatKDoesAlongEachTangent
// Says: This divides by |Kt|
#include <algorithm>

#include "05_friction_box/friction_box.hpp"

namespace spook {

Vec3 friction_impulse(const Mat3& K, const Vec3& u, const Tangents& tangents, double Gamma, double bound) {
  const auto along = [&](const Vec3& t) -> Vec3 {
    const double lambda = -u.dot(t) / ((K * t).norm() + Gamma);
    return std::clamp(lambda, -bound, bound) * t;  // Eq. (5.8)
  };
  return along(tangents.t1) + along(tangents.t2);
}

}  // namespace spook
