#include "01_leapfrog/leapfrog.hpp"
#include "common/not_implemented.hpp"
#include "common/require.hpp"

namespace spook {

void composed_step(Particles& bodies, const ForceField& force, double h, int pairs) {
  // Eq. (1.11) for each part of Eq. (1.13); what goes in and out, and in which units, is in leapfrog.hpp.
  not_implemented("1.5 composed_step", bodies, force, h, pairs);
}

}  // namespace spook
