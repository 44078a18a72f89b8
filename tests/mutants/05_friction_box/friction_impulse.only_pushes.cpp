// Wrong: projects as a contact does, on [0, Λ].
// Killed by: FrictionImpulse.SolvesBothRowsByHand
// Says: Friction pushes both ways along t
#include <algorithm>

#include "05_friction_box/friction_box.hpp"

namespace spook {

Vec3 friction_impulse(const Mat3& K, const Vec3& u, const Tangents& tangents, double Gamma, double bound) {
  const auto along = [&](const Vec3& t) -> Vec3 {
    const double lambda = -u.dot(t) / (t.dot(K * t) + Gamma);
    return std::clamp(lambda, 0.0, bound) * t;
  };
  return along(tangents.t1) + along(tangents.t2);
}

}  // namespace spook
