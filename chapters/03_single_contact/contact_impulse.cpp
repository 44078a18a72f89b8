#include "03_single_contact/single_contact.hpp"
#include "common/not_implemented.hpp"

namespace spook {

double contact_impulse(const SpookParameters& spook, double nKn, double gap, double normal_velocity,
                       double force_velocity) {
  // Eq. (3.10), (3.11); what goes in and out, and in which units, is in single_contact.hpp.
  not_implemented("3.4 contact_impulse", spook, nKn, gap, normal_velocity, force_velocity);
}

}  // namespace spook
