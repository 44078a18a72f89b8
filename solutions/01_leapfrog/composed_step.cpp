#include <cmath>

#include "01_leapfrog/leapfrog.hpp"
#include "common/require.hpp"

namespace spook {

static void drift_all(Particles& bodies, double h) {
  for (std::size_t i = 0; i < bodies.x.size(); ++i) bodies.x[i] = drift(bodies.x[i], bodies.v[i], h);
}

void composed_step(Particles& bodies, const ForceField& force, double h, int pairs) {
  require_positive("h", h);
  if (pairs < 1) reject("pairs", pairs, "at least 1");
  const double w = 1 / (2 * pairs - std::cbrt(2 * pairs));  // Eq. (1.13)
  for (int n = -pairs; n <= pairs; ++n) {
    const double part = n == 0 ? (1 - 2 * pairs * w) * h : w * h;
    drift_all(bodies, part / 2);  // Eq. (1.11)
    for (std::size_t i = 0; i < bodies.x.size(); ++i)
      bodies.v[i] = kick(bodies.v[i], force(i, bodies.x), bodies.inverse_mass[i], part);
    drift_all(bodies, part / 2);
  }
}

}  // namespace spook
