// Wrong: leaves the force term out.
// Killed by: ContactImpulse.SettlesToADepthOfMgOverK
// Says: the force term is missing
#include <algorithm>

#include "03_single_contact/single_contact.hpp"

namespace spook {

double contact_impulse(const Spook& spook, double nKn, double gap, double normal_velocity, double) {
  const double B = -spook.a * gap - spook.b * normal_velocity;
  return std::max(0.0, B / (nKn + spook.Sigma));
}

}  // namespace spook
