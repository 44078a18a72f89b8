// Wrong: lets only penetrating contacts push.
// Killed by: ContactImpulse.SolvesTheRowWheneverItPushes
// Says: An open gap may close within this step
#include <algorithm>

#include "03_single_contact/single_contact.hpp"

namespace spook {

double contact_impulse(const Spook& spook, double nKn, double gap, double normal_velocity,
                       double force_velocity) {
  if (gap > 0) return 0;
  const double B = -spook.a * gap - spook.b * normal_velocity - force_velocity;
  return std::max(0.0, B / (nKn + spook.Sigma));
}

}  // namespace spook
