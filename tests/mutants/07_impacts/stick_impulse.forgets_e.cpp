// Wrong: stops the contact.
// Killed by: StickImpulse.OfASphereByHand
// Says: the restitution is missing
#include <Eigen/Cholesky>

#include "07_impacts/impacts.hpp"

namespace spook {

Vec3 stick_impulse(const Mat3& K, const Vec3& u, const Vec3&, double) {
  return K.llt().solve(-u);
}

}  // namespace spook
