// Wrong: applies e to the whole velocity.
// Killed by: StickImpulse.OfASphereByHand
// Says: which reverses the slip, too
#include <Eigen/Cholesky>

#include "07_impacts/impacts.hpp"

namespace spook {

Vec3 stick_impulse(const Mat3& K, const Vec3& u, const Vec3&, double e) {
  return K.llt().solve(-(1 + e) * u);
}

}  // namespace spook
