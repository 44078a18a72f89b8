// One spring, one contact, and towers of them.
#include <algorithm>
#include <cmath>

#include "stepping.hpp"

namespace spook {
namespace {

using testing::step_on;

constexpr double g = 9.81;

World<3> mass_on_a_force(double k) {
  const ForceField spring = [k](std::size_t, const std::vector<Vec3>& x) -> Vec3 { return -k * x[0]; };
  World<3> world({.gravity = Vec3::Zero(), .force = spring});
  world.add({.x = Vec3::UnitX()});
  return world;
}

TEST(Spring, AsAForceHoldsBelowTwoOverOmega) {
  for (const double k : {1.0, 1e4, 1e8})
    for (const double turn : {0.1, 1.0, 1.9, 1.99}) {
      const double h = turn / std::sqrt(k);
      World<3> world = mass_on_a_force(k);
      world.start_half_step_back(h);
      double farthest = 0;
      EXPECT_EQ(step_on(world, h, 2000, [&] { farthest = std::max(farthest, std::abs(world.x(0).x())); }),
                2000);
      // x_n = cos nθ. Round-off in v is a swing of its own, with an amplitude of up to h/sin θ; four units of 2⁻⁵³ a
      // step, all in one direction.
      const double roundings = 4 * 2000 * 1.2e-16 * turn / std::sqrt(1 - turn * turn / 4);
      EXPECT_LE(farthest, 1 + roundings / turn) << "k " << k << ", hω " << turn;
    }
}

TEST(Spring, AsAForceAboveThatStepIsFiniteOrReported) {
  for (const double turn : {2.01, 3.0, 30.0, 1e4}) {
    const double h = turn / std::sqrt(1e4);
    World<3> world = mass_on_a_force(1e4);
    world.start_half_step_back(h);
    step_on(world, h, 10'000);
  }
}

TEST(Spring, AsADistanceHoldsForAnyStep) {
  // Both roots of Eq. (3.14) are within the unit circle. For d >= 1/4 the initial amplitude is the largest, without a
  // larger swing to the other side.
  for (const double k : {1.0, 1e2, 1e4, 1e8, 1e12})
    for (const double d : {0.25, 0.5, 3.0, 50.0})
      for (const double h : {1.0 / 1000, 1.0 / 30, 1.0}) {
        World<3> world({.gravity = Vec3::Zero(), .k = k, .d = d});
        world.add({.x = Vec3::UnitX()});
        world.add_fixed(Vec3(-10, 0, 0));
        world.add_joint({.i = 1, .j = 0, .length = 10});
        double farthest = 0;
        EXPECT_EQ(step_on(world, h, 1000, [&] { farthest = std::max(farthest, std::abs(world.x(0).x())); }),
                  1000);
        EXPECT_LE(farthest, 1 + 1e-12) << "k " << k << ", d " << d << ", h " << h;
      }
}

TEST(RestingContact, IsRightToTheRoundingsOfItsPlace) {
  // See plots/stability/resting.cpp. Let u be the spacing of numbers just below 0.5 m. A depth error below d u/2
  // changes nothing, and mg/k is not a multiple of u. While the ball still bounces, an impulse may be off by as much as
  // u.
  const double u = std::ldexp(1, -54);
  for (const double k : {1e2, 1e4, 1e6, 1e9, 1e12})
    for (const double d : {0.25, 0.5, 3.0, 50.0})
      for (const double h : {1.0 / 30, 1.0 / 60, 1.0 / 1000}) {
        World<3> world({.gravity = Vec3(0, 0, -g), .k = k, .d = d});
        world.add_plane(Vec3::UnitZ(), 0);
        const int ball = world.add({.x = Vec3(0, 0, 0.5 - g / k), .radius = 0.5});
        // At rest, up to round-off: does it stay there?
        EXPECT_EQ(step_on(world, h, 2000), 2000);
        const double off = (d / 2 + 1) * u + 8 * 1.2e-16 * g / k;  // the second of two results for g/k
        EXPECT_NEAR(0.5 - world.x(ball).z(), g / k, off) << "k " << k << ", d " << d << ", h " << h;
        ASSERT_EQ(world.contacts().size(), 1U);
        EXPECT_NEAR(world.lambda(0), h * g, spook_parameters(h, k, d).a * u + 8 * 1.2e-16 * h * g);
      }
}

/// Spheres of radius 0.5 m stacked from the floor, in contact.
World<3> tower(const std::vector<double>& masses, double k, int sweeps) {
  World<3> world({.gravity = Vec3(0, 0, -g), .k = k, .solver_limits = {.max_sweeps = sweeps}});
  world.add_plane(Vec3::UnitZ(), 0);
  for (std::size_t i = 0; i < masses.size(); ++i)
    world.add({.x = Vec3(0, 0, 0.5 + static_cast<double>(i)), .mass = masses[i], .radius = 0.5});
  return world;
}

TEST(Tower, OfTwoIsRightAfterTheSweepsOfItsRatio) {
  // Too deep by (h N₂/(a m)) ρⁿ⁻¹ (1-ρ)/(1-ρⁿ), Eq. (4.10): solved for the n that gives 1 per cent of N/k.
  const double h = 1.0 / 60, k = 1e6, d = 3;
  for (const double ratio : {1e-3, 1.0, 1e2, 3e3}) {
    const double light = 1 / ratio, soft = light * spook_parameters(h, k, d).Sigma;
    const double rho = 1 / ((1 + soft) * (1 + light + soft));
    const double right = (1 + light) * g / k, first = h * h * (1 + 4 * d) / 4 * g / light * (1 - rho) / rho;
    const int sweeps = static_cast<int>(std::ceil(std::log(1 + first / (0.01 * right)) / -std::log(rho)));
    World<3> world = tower({light, 1}, k, sweeps);
    EXPECT_EQ(step_on(world, h, 100), 100);
    EXPECT_NEAR(0.5 - world.x(1).z(), right, 0.011 * right) << ratio << ":1";
  }
}

TEST(Tower, OfEqualsIsRightAfterSquaredSweeps) {
  // The slowest error shrinks by cos²(π/(2n)) a sweep; its initial value is the first one divided by mΣ of the depth.
  const double h = 1.0 / 60, k = 1e8, d = 3;
  for (const int n : {2, 5, 20}) {
    const double slow = std::pow(3.14159 / (2 * n), 2);
    const double first = slow / spook_parameters(h, k, d).Sigma;
    const int sweeps = static_cast<int>(std::ceil(std::log(1 + first / 0.01) / slow));
    World<3> world = tower(std::vector<double>(static_cast<std::size_t>(n), 1.0), k, sweeps);
    EXPECT_EQ(step_on(world, h, 100), 100);
    EXPECT_NEAR(0.5 - world.x(1).z(), n * g / k, 0.02 * n * g / k) << n << " spheres";
  }
}

TEST(Tower, BeyondItsSweepsIsFiniteOrReported) {
  for (const double ratio : {1e4, 1e8}) {
    World<3> world = tower({1 / ratio, 1}, 1e12, 10);
    step_on(world, 1.0 / 30, 1000);
  }
  World<3> high = tower(std::vector<double>(100, 1.0), 1e12, 1);
  step_on(high, 1.0 / 30, 200);
}

}  // namespace
}  // namespace spook
