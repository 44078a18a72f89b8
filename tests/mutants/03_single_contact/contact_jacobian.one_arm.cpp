// Wrong: measures both lever arms from the centre of j.
// Killed by: ContactJacobian.HasFourBlocks
// Says: This used r_j for body i
#include "03_single_contact/single_contact.hpp"

namespace spook {

ContactJacobian contact_jacobian(const Contact& contact) {
  ContactJacobian G;
  G.Gi << -contact.n, -contact.r_j.cross(contact.n);
  G.Gj << contact.n, contact.r_j.cross(contact.n);
  return G;
}

}  // namespace spook
