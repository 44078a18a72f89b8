// Wrong: pushes i along n and j against it.
// Killed by: ContactJacobian.TimesVelocityIsTheRateOfTheGap
// Says: the rate at which the gap closes
#include "03_single_contact/single_contact.hpp"

namespace spook {

ContactJacobian contact_jacobian(const Contact& contact) {
  ContactJacobian G;
  G.Gi << contact.n, contact.r_i.cross(contact.n);
  G.Gj << -contact.n, -contact.r_j.cross(contact.n);
  return G;
}

}  // namespace spook
