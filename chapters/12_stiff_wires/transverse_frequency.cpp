#include "12_stiff_wires/stiff_wires.hpp"
#include "common/not_implemented.hpp"
#include "common/require.hpp"

namespace spook {

double transverse_frequency(double tension, double mass, double length) {
  // Eq. (12.1); what goes in and out, and in which units, is in stiff_wires.hpp.
  not_implemented("12.1 transverse_frequency", tension, mass, length);
}

}  // namespace spook
