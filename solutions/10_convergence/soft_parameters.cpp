#include <numbers>

#include "10_convergence/convergence.hpp"
#include "common/require.hpp"

namespace spook {

SoftParameters soft_parameters(double h, double frequency, double damping) {
  require_positive("h", h);
  require_positive("frequency", frequency);
  require_not_negative("damping", damping);

  // S/Σ = hω (2ζ + hω)                                                     Eq. (10.17), (10.20)
  const double omega = 2 * std::numbers::pi * frequency;
  const double damped = 2 * damping + h * omega;
  const double stiffness = h * omega * damped;
  return {.bias_rate = omega / damped,
          .mass_scale = stiffness / (1 + stiffness),
          .impulse_scale = 1 / (1 + stiffness)};
}

}  // namespace spook
