// Wrong: leaves the slip as it was.
// Killed by: StickImpulse.OfASphereByHand
// Says: This leaves the slip as it was
#include <Eigen/Cholesky>

#include "07_impacts/impacts.hpp"

namespace spook {

Vec3 stick_impulse(const Mat3& K, const Vec3& u, const Vec3& n, double e) {
  return K.llt().solve(-(1 + e) * u.dot(n) * n);
}

}  // namespace spook
