// Wrong: forgets the minus of the angular block of i.
// Killed by: ContactJacobian.GivesNoAngularMomentum
// Says: Two opposite pushes at one point have no torque
#include "03_single_contact/single_contact.hpp"

namespace spook {

ContactJacobian contact_jacobian(const Contact& contact) {
  ContactJacobian G;
  G.Gi << -contact.n, contact.r_i.cross(contact.n);
  G.Gj << contact.n, contact.r_j.cross(contact.n);
  return G;
}

}  // namespace spook
