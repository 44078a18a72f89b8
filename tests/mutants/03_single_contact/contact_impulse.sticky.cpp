// Wrong: leaves the projection out: the contact pulls.
// Killed by: ContactImpulse.NeverPulls
// Says: a contact is sticky
#include "03_single_contact/single_contact.hpp"

namespace spook {

double contact_impulse(const Spook& spook, double nKn, double gap, double normal_velocity,
                       double force_velocity) {
  const double B = -spook.a * gap - spook.b * normal_velocity - force_velocity;
  return B / (nKn + spook.Sigma);
}

}  // namespace spook
