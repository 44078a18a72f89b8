// Wrong: takes the tension for a spring constant.
// Killed by: TransverseFrequency.IsThatOfNeighboursOnEitherSide
// Says: l is missing
#include "12_stiff_wires/stiff_wires.hpp"
#include "common/require.hpp"

namespace spook {

double transverse_frequency(double tension, double mass, double length) {
  require_not_negative("tension", tension);
  require_positive("mass", mass);
  require_positive("length", length);
  return std::sqrt(4 * tension / mass);
}

}  // namespace spook
