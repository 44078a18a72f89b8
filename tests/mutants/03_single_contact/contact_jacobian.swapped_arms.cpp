// Wrong: gives each body the lever arm of the other.
// Killed by: ContactJacobian.HasFourBlocks
// Says: This used r_i for body j
#include "03_single_contact/single_contact.hpp"

namespace spook {

ContactJacobian contact_jacobian(const Contact& contact) {
  ContactJacobian G;
  G.Gi << -contact.n, -contact.r_j.cross(contact.n);
  G.Gj << contact.n, contact.r_i.cross(contact.n);
  return G;
}

}  // namespace spook
