// Wrong: takes masses, as the notes do not say which of K and K⁻¹ it is.
// Killed by: CollisionMatrix.TimesImpulseIsTheChangeOfRelativeVelocity
// Says: InverseMass::linear is 1/m already
#include "03_single_contact/single_contact.hpp"

namespace spook {

static Mat3 cross_matrix(const Vec3& r) {
  Mat3 result;
  result << 0, -r.z(), r.y(),  //
      r.z(), 0, -r.x(),        //
      -r.y(), r.x(), 0;
  return result;
}

Mat3 collision_matrix(const InverseMass<6>& body_i, const Vec3& r_i, const InverseMass<6>& body_j,
                      const Vec3& r_j) {
  const Mat3 Ri = cross_matrix(r_i), Rj = cross_matrix(r_j);
  return (1 / body_i.linear + 1 / body_j.linear) * Mat3::Identity() - Ri * body_i.angular * Ri -
         Rj * body_j.angular * Rj;
}

}  // namespace spook
