// Wrong: solves K J = -u, and takes what is along the plane.
// Killed by: FrictionImpulse.StopsThePointWhereItCan
// Says: This takes -K⁻¹u, which would stop the motion along the normal
#include <algorithm>

#include "05_friction_box/friction_box.hpp"

namespace spook {

Vec3 friction_impulse(const Mat3& K, const Vec3& u, const Tangents& tangents, double Gamma, double bound) {
  const Vec3 J = -(K + Gamma * Mat3::Identity()).inverse() * u;
  const auto along = [&](const Vec3& t) -> Vec3 { return std::clamp(J.dot(t), -bound, bound) * t; };
  return along(tangents.t1) + along(tangents.t2);
}

}  // namespace spook
