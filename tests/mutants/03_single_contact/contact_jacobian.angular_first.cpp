// Wrong: puts the angular part before the linear one.
// Killed by: ContactJacobian.TurnsABodyAboutItsContactPoint
// Says: The linear part comes first
#include "03_single_contact/single_contact.hpp"

namespace spook {

ContactJacobian contact_jacobian(const Contact& contact) {
  ContactJacobian G;
  G.Gi << -contact.r_i.cross(contact.n), -contact.n;
  G.Gj << contact.r_j.cross(contact.n), contact.n;
  return G;
}

}  // namespace spook
