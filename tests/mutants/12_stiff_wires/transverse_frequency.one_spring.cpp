// Wrong: leaves out the 4.
// Killed by: TransverseFrequency.IsThatOfNeighboursOnEitherSide
// Says: the factor 4 is missing
#include "12_stiff_wires/stiff_wires.hpp"
#include "common/require.hpp"

namespace spook {

double transverse_frequency(double tension, double mass, double length) {
  require_not_negative("tension", tension);
  require_positive("mass", mass);
  require_positive("length", length);
  return std::sqrt(tension / (mass * length));
}

}  // namespace spook
