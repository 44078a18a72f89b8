// Wrong: takes the absolute value where the larger of λ and 0 belongs.
// Killed by: ContactImpulse.NeverPulls
// Says: This is |λ|
#include <cmath>

#include "03_single_contact/single_contact.hpp"

namespace spook {

double contact_impulse(const Spook& spook, double nKn, double gap, double normal_velocity,
                       double force_velocity) {
  const double B = -spook.a * gap - spook.b * normal_velocity - force_velocity;
  return std::abs(B / (nKn + spook.Sigma));
}

}  // namespace spook
