// Wrong: knows no rotation.
// Killed by: CollisionMatrix.OfASphereOnAPlane
// Says: also turns a sphere
#include "03_single_contact/single_contact.hpp"

namespace spook {

Mat3 collision_matrix(const InverseMass<6>& body_i, const Vec3&, const InverseMass<6>& body_j, const Vec3&) {
  return (body_i.linear + body_j.linear) * Mat3::Identity();
}

}  // namespace spook
