// Wrong: lets go of bodies that separate, however deep they are.
// Killed by: ContactImpulse.SolvesTheRowWheneverItPushes
// Says: a deep contact that opens slowly still needs a push
#include <algorithm>

#include "03_single_contact/single_contact.hpp"

namespace spook {

double contact_impulse(const Spook& spook, double nKn, double gap, double normal_velocity,
                       double force_velocity) {
  if (normal_velocity > 0) return 0;
  const double B = -spook.a * gap - spook.b * normal_velocity - force_velocity;
  return std::max(0.0, B / (nKn + spook.Sigma));
}

}  // namespace spook
