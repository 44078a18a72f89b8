// Wrong: divides by the diagonal of K, along x, y and z.
// Killed by: FrictionImpulse.DividesByWhatKDoesAlongEachTangent
// Says: K.diagonal() is what K does along x, y and z
#include <algorithm>

#include "05_friction_box/friction_box.hpp"

namespace spook {

Vec3 friction_impulse(const Mat3& K, const Vec3& u, const Tangents& tangents, double Gamma, double bound) {
  const auto along = [&](const Vec3& t) -> Vec3 {
    const double lambda = -u.cwiseQuotient(K.diagonal() + Vec3::Constant(Gamma)).dot(t);
    return std::clamp(lambda, -bound, bound) * t;  // Eq. (5.8)
  };
  return along(tangents.t1) + along(tangents.t2);
}

}  // namespace spook
