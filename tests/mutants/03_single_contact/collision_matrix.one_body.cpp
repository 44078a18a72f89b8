// Wrong: counts body j alone, as if i were the ground.
// Killed by: CollisionMatrix.TimesImpulseIsTheChangeOfRelativeVelocity
// Says: Only body j gives way here
#include "03_single_contact/single_contact.hpp"

namespace spook {

static Mat3 cross_matrix(const Vec3& r) {
  Mat3 result;
  result << 0, -r.z(), r.y(),  //
      r.z(), 0, -r.x(),        //
      -r.y(), r.x(), 0;
  return result;
}

Mat3 collision_matrix(const InverseMass<6>&, const Vec3&, const InverseMass<6>& body_j, const Vec3& r_j) {
  const Mat3 Rj = cross_matrix(r_j);
  return body_j.linear * Mat3::Identity() - Rj * body_j.angular * Rj;
}

}  // namespace spook
