#include "03_single_contact/single_contact.hpp"

namespace spook {

ContactJacobian contact_jacobian(const Contact& contact) {
  ContactJacobian G;  // Eq. (3.3)
  G.Gi = twist(-contact.n, -contact.r_i.cross(contact.n));
  G.Gj = twist(contact.n, contact.r_j.cross(contact.n));
  return G;
}

}  // namespace spook
