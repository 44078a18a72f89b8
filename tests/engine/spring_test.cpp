// Springs and dampers of hinges and sliders, against closed forms.
#include <gtest/gtest.h>

#include <cmath>

#include "engine/diagnostics/run_check.hpp"
#include "engine/world/world.hpp"
#include "refusals.hpp"

namespace spook::spring_test {
namespace {

constexpr double g = 9.81;
constexpr double inertia = 0.25;  // about the hinge [kg m²]

/// A disc on a hinge along z, at the angle 0.
struct TorsionPendulum {
  World<6> world;
  int hinge;

  TorsionPendulum(const Spring& spring, const Vec3& gravity = Vec3::Zero(), int max_parts = 32)
      : world({.gravity = gravity, .max_parts = max_parts}) {
    const int base = world.add_fixed(Vec3::Zero());
    const int disc = world.add({.mass = 1, .principal = Vec3(0.15, 0.15, inertia)});
    hinge = world.add_joint({.i = base, .j = disc, .kind = JointKind::hinge, .spring = spring});
  }
  double angle() const { return world.joint_position(hinge); }
};

/// The position of a damped oscillator that is released at 1, with k and c for each unit of inertia.
double damped(double k, double c, double t) {
  const double decay = c / 2, frequency = std::sqrt(k - decay * decay);
  return std::exp(-decay * t) * (std::cos(frequency * t) + decay / frequency * std::sin(frequency * t));
}

/// Runs a world for `time`; returns the verdict.
Verdict run(World<6>& world, double h, double time) {
  RunCheck<6> check;
  check.look(world, h);
  for (int steps = static_cast<int>(std::lround(time / h)); steps > 0; --steps) {
    world.step(h);
    check.look(world, h);
  }
  return check.verdict();
}

TEST(Springs, TorsionPendulumKeepsPeriodAndDecayToSecondOrder) {
  const double k = 10, c = 0.3, time = 2;
  std::vector<double> errors;
  for (const double h : {1.0 / 50, 1.0 / 100, 1.0 / 200, 1.0 / 400}) {
    TorsionPendulum pendulum({.stiffness = k, .damping = c, .rest = -1});
    pendulum.world.start_consistently(h);
    const Verdict verdict = run(pendulum.world, h, time);
    EXPECT_EQ(verdict.state, State::sound) << verdict.reason;
    errors.push_back(std::abs(pendulum.angle() + 1 - damped(k / inertia, c / inertia, time)));
  }
  for (std::size_t n = 1; n < errors.size(); ++n)
    EXPECT_NEAR(std::log2(errors[n - 1] / errors[n]), 2, 0.1) << errors[n - 1] << ", then " << errors[n];
}

TEST(Springs, UndampedPendulumNeitherGainsNorLoses) {
  // The discrete oscillator has the amplitude 1/cos(ωh/2) of one that was released half a step before.
  for (const double h : {1.0 / 30, 1.0 / 60, 1.0 / 240}) {
    const double k = 10, omega = std::sqrt(k / inertia);
    TorsionPendulum pendulum({.stiffness = k, .rest = -1});
    const Verdict verdict = run(pendulum.world, h, 100);
    EXPECT_EQ(verdict.state, State::sound) << verdict.reason;
    double highest = 0;
    for (double t = 0; t < 10; t += h) {
      pendulum.world.step(h);
      highest = std::max(highest, std::abs(pendulum.angle() + 1));
    }
    EXPECT_NEAR(highest, 1, omega * omega * h * h / 4) << "h = " << h;
  }
}

TEST(Springs, NoStiffnessOrDampingMakesAStepUnstable) {
  // The discrete oscillator with 1, 1, -1, -1 has the largest amplitude of all, √2.
  for (const double h : {1.0 / 30, 1.0 / 240})
    for (double k = 0; k <= 1e18; k = k > 0 ? 31 * k : 1)
      for (double c = 0; c <= 1e15; c = c > 0 ? 31 * c : 1e-3) {
        if (k == 0 && c == 0) continue;
        TorsionPendulum pendulum({.stiffness = k, .damping = c, .rest = -1});
        double farthest = 0;
        for (int n = 0; n < 100; ++n) {
          pendulum.world.step(h);
          farthest = std::max(farthest, std::abs(pendulum.angle() + 1));
        }
        ASSERT_LE(farthest, 1.5) << "k = " << k << ", c = " << c << ", h = " << h;
      }
}

TEST(Springs, WhatAStepDoesNotResolveComesToRest) {
  // Beyond h²k = 4 I each step takes the factor √(2I/(h²k - 2I)), and beyond h c = 2 I a damper stops in one. Divided
  // steps would resolve the spring, which then swings.
  const double h = 1.0 / 60;
  for (const double stiffer : {25.0, 1e3, 1e9}) {
    const double k = stiffer * 4 * inertia / (h * h);
    TorsionPendulum pendulum({.stiffness = k, .rest = -1}, Vec3::Zero(), 1);
    const Verdict verdict = run(pendulum.world, h, 20 * h);
    EXPECT_EQ(verdict.state, State::sound) << verdict.reason;
    EXPECT_LE(std::abs(pendulum.angle() + 1), 1e-6) << k;
  }
  TorsionPendulum braked({.damping = 1e9});
  braked.world.turn(1, Quat::Identity(), Vec3(0, 0, 5));
  braked.world.step(h);
  EXPECT_LE(std::abs(braked.world.joint_speed(braked.hinge)), 1e-6);
}

TEST(Springs, DamperAloneSlowsExponentially) {
  const double c = 0.5, speed = 3, time = 1;
  std::vector<double> errors;
  for (const double h : {1.0 / 30, 1.0 / 60, 1.0 / 120}) {
    TorsionPendulum pendulum({.damping = c});
    pendulum.world.turn(1, Quat::Identity(), Vec3(0, 0, speed));
    run(pendulum.world, h, time);
    errors.push_back(
        std::abs(pendulum.world.joint_speed(pendulum.hinge) - speed * std::exp(-c / inertia * time)));
  }
  for (std::size_t n = 1; n < errors.size(); ++n) EXPECT_NEAR(std::log2(errors[n - 1] / errors[n]), 2, 0.1);
}

TEST(Springs, SliderCarriesAWeightAtItsExtension) {
  const double k = 200, c = 15, mass = 2;
  World<6> world({});
  const int top = world.add_fixed(Vec3(0, 0, 3));
  const int weight = world.add({.x = Vec3(0, 0, 3), .mass = mass, .principal = Vec3::Ones()});
  const int slider =
      world.add_joint({.i = top, .j = weight, .kind = JointKind::slider, .spring = Spring{k, c, -0.5}});
  const Verdict verdict = run(world, 1.0 / 60, 20);
  EXPECT_EQ(verdict.state, State::sound) << verdict.reason;
  EXPECT_NEAR(world.joint_position(slider), -0.5 - mass * g / k, 1e-9);
  EXPECT_NEAR(world.spring_force(slider), mass * g, 1e-6);
  EXPECT_NEAR(world.joint_force(slider).z(), mass * g, 1e-6);
}

TEST(Springs, TwoBodiesSwingWithTheirReducedMass) {
  const double k = 30, m1 = 1, m2 = 3, time = 3, h = 1.0 / 1000;
  World<6> world({.gravity = Vec3::Zero()});
  const int a = world.add({.mass = m1, .principal = Vec3::Ones()});
  const int b = world.add({.mass = m2, .principal = Vec3::Ones()});
  const int slider = world.add_joint(
      {.i = a, .j = b, .kind = JointKind::slider, .axis = Vec3::UnitX(), .spring = Spring{k, 0, -1}});
  world.start_consistently(h);
  run(world, h, time);
  // The frequency is low by (ωh)²/12 and the start by as little.
  const double omega = std::sqrt(k * (1 / m1 + 1 / m2));
  EXPECT_NEAR(world.joint_position(slider) + 1, std::cos(omega * time),
              omega * time * omega * omega * h * h / 6);
  EXPECT_NEAR((m1 * world.v(a) + m2 * world.v(b)).norm(), 0, 1e-12);
}

TEST(Springs, HoldAnArmAgainstItsWeight) {
  // A horizontal arm on a spring sags by m g l/k, including the spring's full turns.
  const double length = 0.5, mass = 3;
  for (const double k : {100.0, 1e4, 1e8}) {
    World<6> world({});
    world.add_fixed(Vec3::Zero());
    world.add({.x = Vec3(length, 0, 0), .mass = mass, .principal = Vec3(0.01, 0.1, 0.1)});
    const int hinge = world.add_joint({.i = 0,
                                       .j = 1,
                                       .p_j = Vec3(-length, 0, 0),
                                       .kind = JointKind::hinge,
                                       .axis = Vec3::UnitY(),
                                       .spring = Spring{.stiffness = k, .damping = 0.05 * k}});
    const Verdict verdict = run(world, 1.0 / 60, 10);
    EXPECT_EQ(verdict.state, State::sound) << verdict.reason;
    const double angle = world.joint_position(hinge);
    EXPECT_NEAR(k * angle, mass * g * length * std::cos(angle), 1e-4 * mass * g * length) << "k = " << k;
  }
}

TEST(Springs, FollowANewRestAsAServo) {
  TorsionPendulum pendulum({.stiffness = 100, .damping = 10});
  run(pendulum.world, 1.0 / 60, 1);
  pendulum.world.set_spring(pendulum.hinge, Spring{.stiffness = 100, .damping = 10, .rest = 9});
  run(pendulum.world, 1.0 / 60, 5);
  EXPECT_NEAR(pendulum.angle(), 9, 1e-6);  // more than a turn
  pendulum.world.set_spring(pendulum.hinge, {});
  EXPECT_EQ(pendulum.world.spring_force(pendulum.hinge), 0);
  pendulum.world.step(1.0 / 60);
  EXPECT_EQ(pendulum.world.report().rows, 5);
}

TEST(Springs, AreARowBeforeTheMotor) {
  World<6> world({.gravity = Vec3::Zero()});
  world.add_fixed(Vec3::Zero());
  world.add({.mass = 1, .principal = Vec3::Constant(0.1)});
  const int hinge = world.add_joint({.i = 0,
                                     .j = 1,
                                     .kind = JointKind::hinge,
                                     .limits = JointLimits{-1, 1},
                                     .spring = Spring{.stiffness = 10, .damping = 1},
                                     .motor = Motor{.speed = 1, .strength = 2}});
  const Verdict verdict = run(world, 1.0 / 60, 2);
  EXPECT_EQ(verdict.state, State::sound) << verdict.reason;
  EXPECT_EQ(world.report().rows, 8);
  EXPECT_NEAR(world.joint_position(hinge), 0.2, 1e-3);  // where 10 N m/rad hold 2 N m
  EXPECT_NEAR(world.spring_force(hinge), -2, 1e-2);
  EXPECT_NEAR(world.motor_force(hinge), 2, 1e-6);
  EXPECT_EQ(world.limit_force(hinge), 0);
}

TEST(Springs, RefuseWhatIsNoSpring) {
  World<6> world({});
  world.add_fixed(Vec3::Zero());
  world.add({.mass = 1, .principal = Vec3::Ones()});
  const auto add = [&](const Spring& spring, JointKind kind = JointKind::hinge) {
    world.add_joint({.i = 0, .j = 1, .kind = kind, .spring = spring});
  };
  expect_refusal({"stiffness", "-1"}, [&] { add({.stiffness = -1}); });
  expect_refusal({"stiffness", "inf"}, [&] { add({.stiffness = infinity}); });
  expect_refusal({"damping", "-2"}, [&] { add({.stiffness = 1, .damping = -2}); });
  expect_refusal({"stiffness", "damping"}, [&] { add({}); });
  expect_refusal({"rest", "nan"}, [&] { add({.stiffness = 1, .rest = NAN}); });
  expect_refusal({"hinge", "ball"}, [&] { add({.stiffness = 1}, JointKind::ball); });
  EXPECT_TRUE(world.joints().empty());
  add({.stiffness = 1});
  expect_refusal({"damping"}, [&] { world.set_spring(0, Spring{.stiffness = 1, .damping = NAN}); });
  World<6> smooth({.integrator_order = 4});
  smooth.add_fixed(Vec3::Zero());
  smooth.add({.mass = 1, .principal = Vec3::Ones()});
  expect_refusal({"integrator_order", "spring"}, [&] {
    smooth.add_joint({.i = 0, .j = 1, .kind = JointKind::hinge, .spring = Spring{.stiffness = 1}});
  });
}

}  // namespace
}  // namespace spook::spring_test
