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
  const Mat3 Ri = cross_matrix(r_i);
  const Mat3 Rj = cross_matrix(r_j);
  // K = (1/m_i + 1/m_j) 1 - [r_i] I_i⁻¹ [r_i] - [r_j] I_j⁻¹ [r_j]         Eq. (3.8)
  return (body_i.linear + body_j.linear) * Mat3::Identity() - Ri * body_i.angular * Ri -
         Rj * body_j.angular * Rj;
}

}  // namespace spook
