// Wrong: checks nothing.
// Killed by: TransverseFrequency.RefusesWhatIsNoWire
// Says: A wire under a negative tension has no frequency
#include <cmath>
#include "12_stiff_wires/stiff_wires.hpp"

namespace spook {

double transverse_frequency(double tension, double mass, double length) {
  return std::sqrt(4 * tension / (mass * length));  // Eq. (12.1)
}

}  // namespace spook
