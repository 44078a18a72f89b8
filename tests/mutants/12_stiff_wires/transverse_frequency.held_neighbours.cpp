// Wrong: takes a point between two that are held.
// Killed by: TransverseFrequency.IsThatOfNeighboursOnEitherSide
// Says: of a point between two that are held
#include "12_stiff_wires/stiff_wires.hpp"
#include "common/require.hpp"

namespace spook {

double transverse_frequency(double tension, double mass, double length) {
  require_not_negative("tension", tension);
  require_positive("mass", mass);
  require_positive("length", length);
  return std::sqrt(2 * tension / (mass * length));
}

}  // namespace spook
