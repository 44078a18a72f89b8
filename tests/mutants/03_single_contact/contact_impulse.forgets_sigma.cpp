// Wrong: divides by n·Kn alone.
// Killed by: ContactImpulse.SettlesToADepthOfMgOverK
// Says: It does not sink in at all
#include <algorithm>

#include "03_single_contact/single_contact.hpp"

namespace spook {

double contact_impulse(const Spook& spook, double nKn, double gap, double normal_velocity,
                       double force_velocity) {
  const double B = -spook.a * gap - spook.b * normal_velocity - force_velocity;
  return std::max(0.0, B / (nKn));
}

}  // namespace spook
