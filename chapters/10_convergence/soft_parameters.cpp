#include "10_convergence/convergence.hpp"
#include "common/not_implemented.hpp"
#include "common/require.hpp"

namespace spook {

SoftParameters soft_parameters(double h, double frequency, double damping) {
  // Eq. (10.20); what goes in and out, and in which units, is in convergence.hpp.
  not_implemented("10.10 soft_parameters", h, frequency, damping);
}

}  // namespace spook
