#include "05_friction_box/friction_box.hpp"
#include "common/not_implemented.hpp"
#include "common/require.hpp"

namespace spook {

double representative_mass(double inverse_mass_i, double inverse_mass_j, int contacts) {
  // Eq. (5.6); what goes in and out, and in which units, is in friction_box.hpp.
  not_implemented("5.3 representative_mass", inverse_mass_i, inverse_mass_j, contacts);
}

}  // namespace spook
