// The known errors of the friction box, to their exact size: its bound comes from a mass, not from the load, Eq.
// (5.15).
#include <gtest/gtest.h>

#include <cmath>

#include "engine/world/world.hpp"

namespace spook::box_artefacts_test {
namespace {

constexpr double g = 9.81, radius = 0.5, k = 1e6, h = 1.0 / 60;

/// Speed of the fastest of n equal spheres, stacked as points on a slope, after a second from rest.
double speed_of_pile_on_slope(int n, double mu, double angle) {
  World<3> world({.gravity = g * Vec3(std::sin(angle), 0, -std::cos(angle)),
                  .k = k,
                  .friction = mu,
                  .viscosity = infinity,
                  .solver = automatic<3>(FrictionModel::box),
                  .solver_limits = {.max_sweeps = 20'000, .tolerance = 1e-14}});
  world.add_plane(Vec3::UnitZ(), 0);
  double z = radius;
  for (int i = 0; i < n; ++i) {
    z -= (n - i) * g * std::cos(angle) / k;  // at rest from the start: gap = -N/k, Eq. (3.13)
    world.add({.x = Vec3(0, 0, z), .radius = radius});
    z += 2 * radius;
  }
  for (int step = 0; step < 60; ++step) world.step(h);
  double fastest = 0;
  for (int i = 1; i <= n; ++i) fastest = std::max(fastest, world.v(i).norm());
  return fastest;
}

TEST(FrictionBox, APileOnASlopeNeedsMoreFrictionThanABody) {
  // The ground needs the bound for n weights and has it for one. Contact i above it needs n - i and has half a bound.
  const double angle = 0.2;
  const auto needed = [&](int n) {
    double factor = n;
    for (int i = 1; i < n; ++i) factor = std::max(factor, 2.0 * (n - i));
    return factor * std::tan(angle);
  };
  EXPECT_DOUBLE_EQ(needed(1), std::tan(angle));
  EXPECT_DOUBLE_EQ(needed(2), 2 * std::tan(angle));
  EXPECT_DOUBLE_EQ(needed(3), 4 * std::tan(angle)) << "between the first and the second";
  for (const int n : {1, 2, 3}) {
    // In a second, a bound that is a thousandth too small in each step moves a sphere at some hundredths of g sin θ · 1
    // s or more.
    EXPECT_GT(speed_of_pile_on_slope(n, 0.99 * needed(n), angle), 0.005 * g * std::sin(angle))
        << n << " spheres";
    EXPECT_LT(speed_of_pile_on_slope(n, 1.01 * needed(n), angle), 1e-10) << n << " spheres";
  }
}

}  // namespace
}  // namespace spook::box_artefacts_test
