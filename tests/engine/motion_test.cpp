// Bodies without contacts: motions for which leapfrog is exact, and conserved quantities.
#include <gtest/gtest.h>

#include <cmath>

#include "engine/bodies/conserved_quantities.hpp"
#include "engine/world/world.hpp"

namespace spook::motion_test {
namespace {

constexpr double epsilon = 2.2e-16;
constexpr double g = 9.81;

TEST(FreeFall, UnshiftedStartGivesTheDiscreteSum) {
  for (const double h : {0.1, 1.0 / 60, 0.001}) {
    World<3> world({.gravity = Vec3(0, 0, -g)});
    world.add({.mass = 2.5});
    for (int n = 1; n <= 1000; ++n) {
      world.step(h);
      const double answer = -g * h * h * n * (n + 1.0) / 2;
      // Each step rounds v and x once or twice, and the round-off of v adds up in x.
      ASSERT_NEAR(world.x(0).z(), answer, 2 * n * epsilon * std::abs(answer)) << "h " << h << ", step " << n;
    }
  }
}

TEST(FreeFall, HalfStepStartGivesTheParabola) {
  const double h = 1.0 / 60;
  const Vec3 v0(1, -2, 3);
  World<6> world({.gravity = Vec3(0, 0, -g)});
  world.add({.v = v0, .mass = 0.1, .principal = Vec3::Ones()});
  world.start_half_step_back(h);
  for (int n = 1; n <= 1000; ++n) {
    world.step(h);
    const double t = n * h;
    const Vec3 answer = t * v0 + Vec3(0, 0, -g * t * t / 2);
    ASSERT_NEAR((world.x(0) - answer).norm(), 0, 4 * n * epsilon * (t * v0.norm() + g * t * t)) << "step " << n;
    ASSERT_NEAR(world.synchronized_velocity(0, h).z(), v0.z() - g * t, 4 * n * epsilon * (v0.norm() + g * t));
  }
}

TEST(FreeFall, FixedBodiesStay) {
  World<3> world({});
  const int body = world.add_fixed(Vec3(1, 2, 3));
  for (int n = 0; n < 10; ++n) world.step(0.1);
  EXPECT_EQ(world.x(body), Vec3(1, 2, 3));
  EXPECT_EQ(world.v(body), Vec3::Zero().eval());
}

TEST(ForceField, SeesEveryBodyWhereItWasBeforeTheStep) {
  // A spring between two bodies: equal and opposite only if both are evaluated before either moves.
  const ForceField spring = [](std::size_t i, const std::vector<Vec3>& x) -> Vec3 {
    return 100 * (x[1 - i] - x[i]);
  };
  World<3> world({.gravity = Vec3::Zero(), .force = spring});
  world.add({.x = Vec3(1, 0, 0), .v = Vec3(0, 1, 0), .mass = 1});
  world.add({.x = Vec3(-1, 0.5, 0), .mass = 3});
  const Vec3 before = momentum(world.bodies());
  double largest_momentum = 0;
  for (int n = 0; n < 1000; ++n) {
    world.step(0.01);
    largest_momentum = std::max(largest_momentum, 3 * world.v(1).norm());
  }
  EXPECT_GT(largest_momentum, 1) << "nothing happened";
  EXPECT_LE((momentum(world.bodies()) - before).norm(), 1000 * epsilon * largest_momentum);
}

World<6> top(const RotationRule<6>& rule) {
  World<6> world({.gravity = Vec3::Zero(), .rotation = rule});
  world.add({.q = Quat(1, 2, 3, 4).normalized(), .omega = Vec3(0.3, -1, 0.2), .principal = Vec3(1, 2, 3)});
  return world;
}

TEST(Rotation, SplittingKeepsAngularMomentumAndBoundsEnergy) {
  World<6> world = top({RotationUpdate::splitting});
  const Vec3 L = angular_momentum(world.bodies());
  const double T = kinetic_energy(world.bodies());
  const double h = 0.02;
  double band = 0;
  const int steps = 100'000;
  for (int n = 0; n < steps; ++n) {
    world.step(h);
    const double off = std::abs(kinetic_energy(world.bodies()) - T) / T;
    ASSERT_FALSE(std::isnan(off));
    band = std::max(band, off);
  }
  // A few units of round-off a step, possibly all in one direction.
  EXPECT_LE((angular_momentum(world.bodies()) - L).norm(), 4 * steps * epsilon * L.norm());
  // Reversible and of second order: the error is a multiple of (h|ω|)² that does not grow.
  EXPECT_LE(band, h * h * angular_velocity(world, 0).squaredNorm());
  EXPECT_NEAR(orientation(world, 0).norm(), 1, 4 * epsilon);
}

TEST(Rotation, ExplicitGyroscopicTorqueGainsEnergyAndLosesWithTheStep) {
  const auto gain = [](RotationUpdate update, double h) {
    World<6> world = top({update, true});
    const double T = kinetic_energy(world.bodies());
    for (int n = 0; n < std::lround(20 / h); ++n) world.step(h);
    return kinetic_energy(world.bodies()) / T - 1;
  };
  for (const RotationUpdate update : {RotationUpdate::first_order, RotationUpdate::exponential}) {
    EXPECT_GT(gain(update, 0.02), 0);
    EXPECT_NEAR(gain(update, 0.01) / gain(update, 0.02), 0.5, 0.1)
        << "first order: half the step, half the gain";
  }
}

TEST(Rotation, UpdatesAgreeAboutAPrincipalAxis) {
  // About a principal axis there is no precession: the turn is hω a step, and 2 atan(hω/2) for the first-order update.
  const double h = 0.05, spin = 2;
  const auto angle = [&](RotationUpdate update) {
    World<6> world({.gravity = Vec3::Zero(), .rotation = {update, true}});
    world.add({.omega = Vec3(0, 0, spin), .principal = Vec3(1, 2, 3)});
    for (int n = 0; n < 10; ++n) world.step(h);
    return 2 * std::atan2(orientation(world, 0).z(), orientation(world, 0).w());
  };
  EXPECT_NEAR(angle(RotationUpdate::splitting), 10 * h * spin, 40 * epsilon);
  EXPECT_NEAR(angle(RotationUpdate::exponential), 10 * h * spin, 40 * epsilon);
  EXPECT_NEAR(angle(RotationUpdate::first_order), 20 * std::atan(h * spin / 2), 40 * epsilon);
}

TEST(Rotation, TurnsARoundBodyExactly) {
  // ω is constant, so the turn is known. Three turns about body axes, which do not commute, would miss it by O(h²).
  const Vec3 omega(1.2, 0.9, 1.3);
  const double h = 0.1;
  World<6> world({.gravity = Vec3::Zero()});
  world.add({.omega = omega, .principal = Vec3(2, 2, 2)});
  for (int n = 0; n < 10; ++n) world.step(h);
  const Quat exact(Eigen::AngleAxisd(10 * h * omega.norm(), omega.normalized()));
  EXPECT_LE(orientation(world, 0).angularDistance(exact), 100 * epsilon);
  EXPECT_EQ(angular_velocity(world, 0), omega);
}

TEST(SimulationDiverged, NamesStepTimeAndBody) {
  const ForceField burst = [](std::size_t i, const std::vector<Vec3>& x) -> Vec3 {
    return i == 1 && x[1].x() > 2.5 ? Vec3(1e308, 0, 0) * 1e10 : Vec3(0, 0, 0);
  };
  World<3> world({.gravity = Vec3::Zero(), .force = burst});
  world.add({.v = Vec3(1, 0, 0)});
  world.add({.v = Vec3(1, 0, 0)});
  try {
    for (int n = 0; n < 10; ++n) world.step(1);
    FAIL() << "no SimulationDiverged";
  } catch (const SimulationDiverged& diverged) {
    EXPECT_EQ(diverged.step(), 4);
    EXPECT_EQ(diverged.time(), 4);
    EXPECT_EQ(diverged.body(), 1);
    EXPECT_STREQ(diverged.what(), "blew up in step 4 (time 4 s): body 1 is not finite");
  }
}

}  // namespace
}  // namespace spook::motion_test
