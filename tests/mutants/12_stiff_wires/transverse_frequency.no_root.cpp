// Wrong: returns ω².
// Killed by: TransverseFrequency.IsThatOfNeighboursOnEitherSide
// Says: take the root
#include "12_stiff_wires/stiff_wires.hpp"
#include "common/require.hpp"

namespace spook {

double transverse_frequency(double tension, double mass, double length) {
  require_not_negative("tension", tension);
  require_positive("mass", mass);
  require_positive("length", length);
  return 4 * tension / (mass * length);
}

}  // namespace spook
