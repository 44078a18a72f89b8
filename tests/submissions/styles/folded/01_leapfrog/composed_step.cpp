#include <cmath>

#include "01_leapfrog/leapfrog.hpp"
#include "common/require.hpp"

namespace spook {

void composed_step(Particles& bodies, const ForceField& force, double h, int pairs) {
  require_positive("h", h);
  if (pairs < 1) reject("pairs", pairs, "at least 1");
  const double share = 1 / (2 * pairs - std::cbrt(2 * pairs));
  // The drifts that meet are one: half of each part's.
  double before = 0;
  for (int n = 0; n <= 2 * pairs + 1; ++n) {
    const double part = n > 2 * pairs ? 0 : n == pairs ? h * (1 - 2 * pairs * share) : h * share;
    for (auto i = 0u; i < bodies.x.size(); ++i)
      bodies.x[i] = drift(bodies.x[i], bodies.v[i], (before + part) / 2);
    if (n <= 2 * pairs)
      for (auto i = 0u; i < bodies.x.size(); ++i)
        bodies.v[i] = kick(bodies.v[i], force(i, bodies.x), bodies.inverse_mass[i], part);
    before = part;
  }
}

}  // namespace spook
