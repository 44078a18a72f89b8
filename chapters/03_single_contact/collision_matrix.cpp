#include "03_single_contact/single_contact.hpp"
#include "common/not_implemented.hpp"

namespace spook {

Mat3 collision_matrix(const InverseMass<6>& body_i, const Vec3& r_i, const InverseMass<6>& body_j,
                      const Vec3& r_j) {
  // Eq. (3.8); what goes in and out, and in which units, is in single_contact.hpp.
  not_implemented("3.3 collision_matrix", body_i, r_i, body_j, r_j);
}

}  // namespace spook
