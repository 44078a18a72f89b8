#include <algorithm>

#include "03_single_contact/single_contact.hpp"

namespace spook {

double contact_impulse(const SpookParameters& spook, double nKn, double gap, double normal_velocity,
                       double force_velocity) {
  const double B = -spook.a * gap - spook.b * normal_velocity - force_velocity;
  // In this order std::max keeps a NaN.
  return std::max(B / (nKn + spook.Sigma), 0.0);  // Eq. (3.10), (3.11)
}

}  // namespace spook
