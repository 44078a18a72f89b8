#include "02_quaternions/quaternions.hpp"
#include "common/not_implemented.hpp"
#include "common/require.hpp"

namespace spook {

void step_free(Simulation& simulation, double h) {
  // Eq. (1.3), (1.4), then (2.6) or (2.11), body by body; see quaternions.hpp and common/simulation.hpp.
  not_implemented("2.7 step_free", simulation, h);
}

}  // namespace spook
