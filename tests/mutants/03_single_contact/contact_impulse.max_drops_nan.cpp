// Wrong: projects in the order in which std::max makes 0 of a NaN.
// Killed by: ContactImpulse.KeepsANaN
// Says: has become a contact at rest
#include <algorithm>

#include "03_single_contact/single_contact.hpp"

namespace spook {

double contact_impulse(const Spook& spook, double nKn, double gap, double normal_velocity,
                       double force_velocity) {
  const double B = -spook.a * gap - spook.b * normal_velocity - force_velocity;
  return std::max(0.0, B / (nKn + spook.Sigma));
}

}  // namespace spook
