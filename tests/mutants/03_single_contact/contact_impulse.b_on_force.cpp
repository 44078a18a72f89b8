// Wrong: weighs the force term by b, too.
// Killed by: ContactImpulse.SolvesOneRowByHand
// Says: b weighs the old velocity only
#include <algorithm>

#include "03_single_contact/single_contact.hpp"

namespace spook {

double contact_impulse(const Spook& spook, double nKn, double gap, double normal_velocity,
                       double force_velocity) {
  const double B = -spook.a * gap - spook.b * (normal_velocity + force_velocity);
  return std::max(0.0, B / (nKn + spook.Sigma));
}

}  // namespace spook
