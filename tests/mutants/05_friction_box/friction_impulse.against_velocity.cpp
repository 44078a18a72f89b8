// Wrong: acts against the velocity at full strength unless less stops it: Coulomb's law, too.
// Killed by: FrictionImpulse.IsBoundedByABox
// Says: This is Coulomb's cone
#include "05_friction_box/friction_box.hpp"

namespace spook {

Vec3 friction_impulse(const Mat3& K, const Vec3& u, const Tangents& tangents, double Gamma, double bound) {
  const auto along = [&](const Vec3& t) -> Vec3 { return -u.dot(t) / (t.dot(K * t) + Gamma) * t; };
  const Vec3 J = along(tangents.t1) + along(tangents.t2);
  if (!(J.norm() > bound)) return J;
  const Vec3 slip = u.dot(tangents.t1) * tangents.t1 + u.dot(tangents.t2) * tangents.t2;
  return -bound * slip.normalized();
}

}  // namespace spook
