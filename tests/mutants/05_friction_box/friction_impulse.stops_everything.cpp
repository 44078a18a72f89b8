// Wrong: solves K J = -u.
// Killed by: FrictionImpulse.SolvesBothRowsByHand
// Says: This is -K⁻¹u in full
#include "05_friction_box/friction_box.hpp"

namespace spook {

Vec3 friction_impulse(const Mat3& K, const Vec3& u, const Tangents&, double, double bound) {
  const Vec3 J = -K.inverse() * u;
  return J.cwiseMax(-bound).cwiseMin(bound);
}

}  // namespace spook
