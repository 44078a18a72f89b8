// Wrong: stops the bodies, and leaves them where they have sunk to.
// Killed by: ContactImpulse.StaysAtRest
// Says: The gap is missing on the right side
#include <algorithm>

#include "03_single_contact/single_contact.hpp"

namespace spook {

double contact_impulse(const Spook& spook, double nKn, double, double normal_velocity, double force_velocity) {
  const double B = -spook.b * normal_velocity - force_velocity;
  return std::max(0.0, B / (nKn + spook.Sigma));
}

}  // namespace spook
