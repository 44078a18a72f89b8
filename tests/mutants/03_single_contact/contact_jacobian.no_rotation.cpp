// Wrong: treats rigid bodies as point masses.
// Killed by: ContactJacobian.TurnsABodyAboutItsContactPoint
// Says: a push beside the centre also turns the body
#include "03_single_contact/single_contact.hpp"

namespace spook {

ContactJacobian contact_jacobian(const Contact& contact) {
  ContactJacobian G;
  G.Gi << -contact.n, Vec3::Zero();
  G.Gj << contact.n, Vec3::Zero();
  return G;
}

}  // namespace spook
