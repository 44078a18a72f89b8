#pragma once
// Runge and Kutta's method as Dormand and Prince have it, orders 5 and 4, with a step that follows the error.
//
// Source: Hairer, Nørsett, Wanner, Solving Ordinary Differential Equations I, II.5, table 5.2.
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <stdexcept>

#include <Eigen/Core>

namespace spook {

using Numbers = Eigen::VectorXd;

/// Returns y at `time`, starting from `y` at 0. The error of a step is at most `tolerance` in every number. After each
/// step `settle` projects y onto the constraints.
inline Numbers dormand_prince(
    const std::function<Numbers(const Numbers&)>& rate, Numbers y, double time, double tolerance,
    const std::function<Numbers(const Numbers&)>& settle = [](const Numbers& now) { return now; }) {
  static constexpr double a[7][6] = {{},
                                     {1.0 / 5},
                                     {3.0 / 40, 9.0 / 40},
                                     {44.0 / 45, -56.0 / 15, 32.0 / 9},
                                     {19372.0 / 6561, -25360.0 / 2187, 64448.0 / 6561, -212.0 / 729},
                                     {9017.0 / 3168, -355.0 / 33, 46732.0 / 5247, 49.0 / 176, -5103.0 / 18656},
                                     {35.0 / 384, 0, 500.0 / 1113, 125.0 / 192, -2187.0 / 6784, 11.0 / 84}};
  static constexpr double e[7] = {71.0 / 57600,      0,          -71.0 / 16695, 71.0 / 1920,
                                  -17253.0 / 339200, 22.0 / 525, -1.0 / 40};
  double t = 0, h = time / 100;
  while (t < time) {
    h = std::min(h, time - t);
    std::array<Numbers, 7> k;
    Numbers next = y;
    for (std::size_t stage = 0; stage < 7; ++stage) {
      next = y;
      for (std::size_t of = 0; of < stage; ++of) next += h * a[stage][of] * k[of];
      k[stage] = rate(next);
    }
    Numbers error = Numbers::Zero(y.size());
    for (std::size_t stage = 0; stage < 7; ++stage) error += h * e[stage] * k[stage];
    const double worst = error.cwiseAbs().maxCoeff() / tolerance;
    if (worst <= 1) {
      t += h;
      y = settle(next);
    }
    if (!(h > 1e-12 * time)) throw std::runtime_error("no step is short enough");
    h *= std::clamp(0.9 * std::pow(std::max(worst, 1e-10), -0.2), 0.2, 5.0);
  }
  return y;
}

}  // namespace spook
