// Wrong: divides by the length twice, as if m were a mass per metre.
// Killed by: TransverseFrequency.IsThatOfNeighboursOnEitherSide
// Says: One l too many
#include "12_stiff_wires/stiff_wires.hpp"
#include "common/require.hpp"

namespace spook {

double transverse_frequency(double tension, double mass, double length) {
  require_not_negative("tension", tension);
  require_positive("mass", mass);
  require_positive("length", length);
  return std::sqrt(4 * tension / mass) / length;
}

}  // namespace spook
