#include "05_friction_box/friction_box.hpp"
#include "common/not_implemented.hpp"
#include "common/require.hpp"

namespace spook {

SpookParameters friction_parameters(double h, double c) {
  // Eq. (5.3), (5.4); what goes in and out, and in which units, is in friction_box.hpp.
  not_implemented("5.2 friction_parameters", h, c);
}

}  // namespace spook
