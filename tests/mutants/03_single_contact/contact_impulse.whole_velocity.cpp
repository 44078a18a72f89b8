// Wrong: takes all of the velocity away, not b of it.
// Killed by: ContactImpulse.SlowsBodiesThatMeet
// Says: b is missing
#include <algorithm>

#include "03_single_contact/single_contact.hpp"

namespace spook {

double contact_impulse(const Spook& spook, double nKn, double gap, double normal_velocity,
                       double force_velocity) {
  const double B = -spook.a * gap - normal_velocity - force_velocity;
  return std::max(0.0, B / (nKn + spook.Sigma));
}

}  // namespace spook
