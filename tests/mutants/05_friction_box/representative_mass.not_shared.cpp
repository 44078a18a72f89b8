// Wrong: gives every contact the whole mass.
// Killed by: RepresentativeMass.BrakesABlockAlikeOnAnyNumberOfContacts
// Says: every contact has the friction of all
#include "05_friction_box/friction_box.hpp"
#include "common/require.hpp"

namespace spook {

double representative_mass(double inverse_mass_i, double inverse_mass_j, int contacts) {
  require_not_negative("inverse_mass_i", inverse_mass_i);
  require_not_negative("inverse_mass_j", inverse_mass_j);
  if (inverse_mass_i + inverse_mass_j == 0)
    reject("inverse_mass_j", inverse_mass_j, "positive where inverse_mass_i is 0");
  if (contacts < 1) reject("contacts", contacts, "at least 1");
  return 1 / (inverse_mass_i + inverse_mass_j);
}

}  // namespace spook
