// Wrong: puts the lever arm itself where its cross product with n belongs.
// Killed by: ContactJacobian.TurnsABodyAboutItsContactPoint
// Says: The angular block is a cross product
#include "03_single_contact/single_contact.hpp"

namespace spook {

ContactJacobian contact_jacobian(const Contact& contact) {
  ContactJacobian G;
  G.Gi << -contact.n, -contact.r_i;
  G.Gj << contact.n, contact.r_j;
  return G;
}

}  // namespace spook
