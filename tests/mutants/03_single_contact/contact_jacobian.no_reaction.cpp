// Wrong: pushes both bodies the same way.
// Killed by: ContactJacobian.PushesBothBodiesAlike
// Says: Action equals reaction
#include "03_single_contact/single_contact.hpp"

namespace spook {

ContactJacobian contact_jacobian(const Contact& contact) {
  ContactJacobian G;
  G.Gi << contact.n, contact.r_i.cross(contact.n);
  G.Gj << contact.n, contact.r_j.cross(contact.n);
  return G;
}

}  // namespace spook
