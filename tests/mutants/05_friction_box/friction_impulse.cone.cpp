// Wrong: shortens the impulse as a whole: Coulomb's law, and better, but not the box.
// Killed by: FrictionImpulse.IsBoundedByABox
// Says: This is Coulomb's cone
#include "05_friction_box/friction_box.hpp"

namespace spook {

Vec3 friction_impulse(const Mat3& K, const Vec3& u, const Tangents& tangents, double Gamma, double bound) {
  const auto along = [&](const Vec3& t) -> Vec3 {
    const double lambda = -u.dot(t) / (t.dot(K * t) + Gamma);
    return lambda * t;
  };
  const Vec3 J = along(tangents.t1) + along(tangents.t2);
  return J.norm() > bound ? Vec3(bound * J.normalized()) : J;
}

}  // namespace spook
