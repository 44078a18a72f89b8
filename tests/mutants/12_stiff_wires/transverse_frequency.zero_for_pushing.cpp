// Wrong: takes a wire that pushes for a slack one.
// Killed by: TransverseFrequency.RefusesWhatIsNoWire
// Says: a tension of -1 N
#include "12_stiff_wires/stiff_wires.hpp"
#include "common/require.hpp"

namespace spook {

double transverse_frequency(double tension, double mass, double length) {
  require_finite("tension", tension);
  if (tension < 0) return 0;
  require_positive("mass", mass);
  require_positive("length", length);
  return std::sqrt(4 * tension / (mass * length));  // Eq. (12.1)
}

}  // namespace spook
