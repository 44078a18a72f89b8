#include "01_leapfrog/leapfrog.hpp"
#include "common/not_implemented.hpp"
#include "common/require.hpp"

namespace spook {

void leapfrog_step(Particles& bodies, const ForceField& force, double h) {
  // Eq. (1.3) for every body, then Eq. (1.4) for every body; what goes in and out, and in which units, is in leapfrog.hpp.
  not_implemented("1.4 leapfrog_step", bodies, force, h);
}

}  // namespace spook
