// Wrong: returns the largest step.
// Killed by: TransverseFrequency.IsThatOfNeighboursOnEitherSide
// Says: the step of Eq. (12.2)
#include "12_stiff_wires/stiff_wires.hpp"
#include "common/require.hpp"

namespace spook {

double transverse_frequency(double tension, double mass, double length) {
  require_not_negative("tension", tension);
  require_positive("mass", mass);
  require_positive("length", length);
  return 2 / std::sqrt(4 * tension / (mass * length));
}

}  // namespace spook
