// Wrong: refuses a tension of 0.
// Killed by: TransverseFrequency.OfASlackWireIsZero
// Says: tension must be positive
#include "12_stiff_wires/stiff_wires.hpp"
#include "common/require.hpp"

namespace spook {

double transverse_frequency(double tension, double mass, double length) {
  require_positive("tension", tension);
  require_positive("mass", mass);
  require_positive("length", length);
  return std::sqrt(4 * tension / (mass * length));  // Eq. (12.1)
}

}  // namespace spook
