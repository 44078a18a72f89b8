// Wrong: crosses n with r instead of r with n.
// Killed by: ContactJacobian.HasFourBlocks
// Says: The angular block is n × r_j
#include "03_single_contact/single_contact.hpp"

namespace spook {

ContactJacobian contact_jacobian(const Contact& contact) {
  ContactJacobian G;
  G.Gi << -contact.n, -contact.n.cross(contact.r_i);
  G.Gj << contact.n, contact.n.cross(contact.r_j);
  return G;
}

}  // namespace spook
