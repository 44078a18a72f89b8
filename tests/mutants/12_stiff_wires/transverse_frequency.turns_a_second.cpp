// Wrong: returns a frequency in turns a second.
// Killed by: TransverseFrequency.IsThatOfNeighboursOnEitherSide
// Says: in turns a second
#include <numbers>
#include "12_stiff_wires/stiff_wires.hpp"

#include "common/require.hpp"

namespace spook {

double transverse_frequency(double tension, double mass, double length) {
  require_not_negative("tension", tension);
  require_positive("mass", mass);
  require_positive("length", length);
  return std::sqrt(4 * tension / (mass * length)) / (2 * std::numbers::pi);
}

}  // namespace spook
