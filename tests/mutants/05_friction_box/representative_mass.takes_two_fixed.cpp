// Wrong: does not see that both bodies are fixed.
// Killed by: RepresentativeMass.RejectsTwoFixedBodies
// Says: Two fixed bodies have no reduced mass
#include "05_friction_box/friction_box.hpp"
#include "common/require.hpp"

namespace spook {

double representative_mass(double inverse_mass_i, double inverse_mass_j, int contacts) {
  require_not_negative("inverse_mass_i", inverse_mass_i);
  require_not_negative("inverse_mass_j", inverse_mass_j);
  if (contacts < 1) reject("contacts", contacts, "at least 1");
  return 1 / ((inverse_mass_i + inverse_mass_j) * contacts);
}

}  // namespace spook
