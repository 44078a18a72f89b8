// Wrong: lets a NaN and an infinity through.
// Killed by: TransverseFrequency.RefusesWhatIsNoWire
// Says: a tension of NaN N
#include "12_stiff_wires/stiff_wires.hpp"
#include "common/require.hpp"

namespace spook {

double transverse_frequency(double tension, double mass, double length) {
  if (tension < 0) reject("tension", tension, "at least 0");
  if (mass <= 0) reject("mass", mass, "positive");
  if (length <= 0) reject("length", length, "positive");
  return std::sqrt(4 * tension / (mass * length));  // Eq. (12.1)
}

}  // namespace spook
