// Wrong: takes n·Kn for a mass.
// Killed by: ContactImpulse.SolvesOneRowByHand
// Says: This took n·Kn for a mass
#include <algorithm>

#include "03_single_contact/single_contact.hpp"

namespace spook {

double contact_impulse(const Spook& spook, double nKn, double gap, double normal_velocity,
                       double force_velocity) {
  const double B = -spook.a * gap - spook.b * normal_velocity - force_velocity;
  return std::max(0.0, B / (1 / nKn + spook.Sigma));
}

}  // namespace spook
