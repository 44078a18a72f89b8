#include "05_friction_box/friction_box.hpp"
#include "common/not_implemented.hpp"
#include "common/require.hpp"

namespace spook {

double friction_bound(double mu, double mass, double normal_gravity, double h) {
  // Eq. (5.7); what goes in and out, and in which units, is in friction_box.hpp.
  not_implemented("5.4 friction_bound", mu, mass, normal_gravity, h);
}

}  // namespace spook
