// Changes of a world between its steps, and steps that end by an exception: no result of an earlier world stays.
#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "engine/diagnostics/run_check.hpp"
#include "engine/diagnostics/spring_energy.hpp"
#include "engine/solvers/registry.hpp"
#include "engine/world/world.hpp"
#include "refusals.hpp"

namespace spook::between_steps_test {
namespace {

constexpr double g = 9.81, h = 1.0 / 60;

Body<6> ball(const Vec3& x, double radius = 0.1) {
  return {.x = x, .mass = 1, .radius = radius};
}

TEST(BetweenSteps, ARemovedBodyLeavesNoResults) {
  World<6> world({.wrench = [](auto, const auto&, double) -> Twist<6> { return Twist<6>::Constant(0.1); },
                  .friction = 0.5});
  world.add_plane(Vec3::UnitZ(), 0);
  for (const double x : {0.0, 1.0}) world.add(ball(Vec3(x, 0, 0.1)));
  for (int n = 0; n < 5; ++n) world.step(h);
  ASSERT_EQ(world.forces().size(), 3u);
  world.remove_body(1);
  EXPECT_TRUE(world.forces().empty());
  EXPECT_TRUE(world.torques().empty());
  EXPECT_TRUE(world.velocity_changes().empty());
  EXPECT_EQ(world.report().iterations, 0);
  EXPECT_EQ(world.report().pairs, 0);
}

TEST(BetweenSteps, TorquesEndWithTheirWrench) {
  World<6> world({.gravity = Vec3::Zero()});
  const int fixed = world.add_fixed(Vec3(5, 0, 0), 0.1), free = world.add(ball(Vec3::Zero()));
  world.set_wrench([](auto, const auto&, double) {
    Twist<6> wrench = Twist<6>::Zero();
    wrench[5] = 0.3;
    return wrench;
  });
  world.step(h);
  ASSERT_EQ(world.torques().size(), 2u);
  EXPECT_EQ(world.torques()[world.index(fixed)], Vec3::Zero());
  EXPECT_EQ(world.torques()[world.index(free)], Vec3(0, 0, 0.3));
  RunCheck<6> check;
  check.look(world, h);
  world.set_wrench(nullptr);
  for (int n = 0; n < 60; ++n) {
    world.step(h);
    check.look(world, h);
    EXPECT_TRUE(world.torques().empty());
  }
  EXPECT_EQ(check.verdict().state, State::sound) << check.verdict().reason;
}

TEST(BetweenSteps, AStepThatThrowsLeavesNoContactWithoutARow) {
  World<6> world({.friction = 0.5});
  const int lift = world.add_fixed_box(Vec3(0, 0, -0.1), Vec3(1, 1, 0.1));
  world.add(ball(Vec3(0, 0, 0.15)));
  bool throws = false;
  world.set_velocity_function(lift, [&](double) -> Twist<6> {
    if (throws) throw std::runtime_error("no velocity");
    return Twist<6>::Zero();
  });
  while (world.contacts().empty()) {
    World<6> before = world;
    before.step(h);
    throws = !before.contacts().empty();  // the first step with a contact does not end
    if (throws) break;
    world.step(h);
  }
  ASSERT_THROW(world.step(h), std::runtime_error);
  for (int contact = 0; contact < std::ssize(world.contacts()); ++contact) EXPECT_GE(world.lambda(contact), 0);
  EXPECT_TRUE(world.contacts().empty());
  EXPECT_EQ(world.report().rows, 0);
  throws = false;
  for (int n = 0; n < 60; ++n) world.step(h);
  EXPECT_NEAR(world.x(1).z(), 0.1, 1e-4);
}

TEST(BetweenSteps, PartsEndWithTheJointThatNeedsThem) {
  World<6> world({.gravity = Vec3::Zero()});
  world.add_fixed(Vec3::Zero());
  const int mass = world.add({.x = Vec3(1, 0, 0), .v = Vec3(0, 50, 0), .mass = 1, .radius = 0.1});
  world.add_joint({.i = 0, .j = mass, .length = 1});
  world.step(h);
  ASSERT_EQ(world.parts(), 8);
  world.remove_joint(0);
  for (int n = 0; n < 400; ++n) world.step(h);
  EXPECT_EQ(world.parts(), 1);
}

/// A ball that rolls, and one on a hinge that is not there yet.
World<6> with_a_rolling_ball() {
  World<6> world({.friction = 0.6});
  world.add_plane(Vec3::UnitZ(), 0);
  Body<6> rolling = ball(Vec3(0, 0, 0.1));
  rolling.v = Vec3(1, 0, 0);
  rolling.omega = Vec3(0, 10, 0);
  const int n = world.add(rolling);
  world.set_material(n, {.rolling_resistance = 0.002});
  world.add_fixed(Vec3(0, 3, 3));
  world.add(ball(Vec3(0.3, 3, 3)));
  return world;
}

TEST(BetweenSteps, ANewJointHasNoImpulse) {
  World<6> world = with_a_rolling_ball();
  for (int n = 0; n < 10; ++n) world.step(h);
  ASSERT_EQ(world.rows().size(), 5u) << "two rows resist rolling, and the contact has three";
  const int hinge = world.add_joint(
      {.i = 2, .j = 3, .p_j = Vec3(-0.3, 0, 0), .kind = JointKind::hinge, .axis = Vec3::UnitY()});
  for (int row = 0; row < world.joints()[0].rows(); ++row) EXPECT_EQ(world.joint_lambda(hinge, row), 0);
  EXPECT_EQ(world.joint_torque(hinge), Vec3::Zero());
  EXPECT_EQ(world.joint_force(hinge), Vec3::Zero());
}

TEST(BetweenSteps, TheEnergyOfSpringsIsThatOfTheirOwnStiffness) {
  // m g presses a spring: (m g)²/2k, in each number of parts.
  World<6> world({.gravity = Vec3(0, 0, -g)});
  world.add_plane(Vec3::UnitZ(), 0);
  const int n = world.add(ball(Vec3(0, 0, 0.1)));
  world.set_material(0, n, {.k = 1e5});
  while (world.time() < 5) world.step(h);
  EXPECT_NEAR(spring_energy(world, h), g * g / 2e5, 1e-6 * g * g / 2e5);
  World<6> soft({.gravity = Vec3(0, 0, -g), .soft_steps = SoftSteps{.substeps = 4}});
  soft.add_fixed(Vec3(0, 0, 5));
  const int hanging = soft.add(ball(Vec3(0, 0, 4)));
  soft.add_joint({.i = 0, .j = hanging, .p_i = Vec3(0, 0, -1), .k = 1e5});
  while (soft.time() < 5) soft.step(h);
  EXPECT_NEAR(spring_energy(soft, h), g * g / 2e5, 1e-3 * g * g / 2e5);
}

TEST(BetweenSteps, WhatOrderFourRefusesIsNotAdded) {
  World<6> world({.integrator_order = 4});
  world.add(ball(Vec3::Zero()));
  EXPECT_THROW(world.add_plane(Vec3::UnitZ(), -5), std::invalid_argument);
  EXPECT_THROW(world.add(ball(Vec3(1, 0, 0))), std::invalid_argument);
  EXPECT_THROW(world.add_fixed(Vec3(1, 0, 0), 0.1), std::invalid_argument);
  EXPECT_EQ(world.bodies().size(), 1u);
  EXPECT_EQ(world.add({.x = Vec3(1, 0, 0), .mass = 1, .principal = Vec3::Ones()}), 1)
      << "a body without a shape may be added";
}

TEST(BetweenSteps, OrderFourRefusesALaterWrenchThatSeesVelocities) {
  World<6> world({.integrator_order = 4});
  world.add(ball(Vec3::Zero()));
  world.step(h);
  world.set_wrench(
      [](std::size_t i, const Bodies<6>& bodies, double) { return Twist<6>(-bodies.motion.W[i]); });
  expect_refusal({"wrench"}, [&] { world.step(h); });
}

TEST(BetweenSteps, TheFrictionBoxNeedsGravityForMaterialsToo) {
  World<6> world({.gravity = Vec3::Zero(),
                  .force = [](auto, const auto&) { return Vec3(0, 0, -g); },
                  .solver = gauss_seidel<6>()});
  world.add_plane(Vec3::UnitZ(), 0);
  const int n = world.add(ball(Vec3(0, 0, 0.1)));
  world.set_material(n, {.restitution = 0.5});
  expect_refusal({"gravity"}, [&] { world.set_material(n, {.friction = 0.5}); });
  expect_refusal({"gravity"}, [&] { world.set_material(0, n, {.friction = 0.5}); });
}

TEST(BetweenSteps, ARemovedMaterialDoesNotChangeImpacts) {
  // Impacts have the law's friction unless a body or pair has a material; whose body it was does not matter.
  const auto spin = [](int which) {
    World<6> world({.impacts = ImpactLaw{.restitution = 0.5, .friction = 0.8}});
    std::vector<int> others;
    for (int n = 0; n < 3; ++n) others.push_back(world.add(ball(Vec3(5 + n, 0, 5))));
    if (which >= 0) world.set_material(others[which], {.friction = 0.3});
    if (which >= 0) world.set_material(others[which], {});
    if (which >= 0) world.remove_body(others[which]);
    world.add_plane(Vec3::UnitZ(), 0);
    Body<6> falling = ball(Vec3(0, 0, 0.2));
    falling.v = Vec3(2, 0, -2);
    const int n = world.add(falling);
    for (int step = 0; step < 10; ++step) world.step(h);
    return angular_velocity(world, n).y();
  };
  const double without = spin(-1);
  EXPECT_GT(without, 10);
  for (const int which : {0, 1, 2}) EXPECT_EQ(spin(which), without) << which;
}

TEST(BetweenSteps, MaterialsWithoutFrictionHaveOneRowAContact) {
  World<6> world({});
  world.add_plane(Vec3::UnitZ(), 0);
  const int n = world.add(ball(Vec3(0, 0, 0.1)));
  world.set_material(n, {.friction = 0.5});
  world.set_material(0, {.friction = 0.5});
  world.step(h);
  EXPECT_EQ(world.rows().size(), 3u);
  for (const int body : {n, 0}) world.set_material(body, {.friction = 0});
  world.step(h);
  EXPECT_EQ(world.rows().size(), 1u);
}

TEST(BetweenSteps, SoftStepsFindWhatASpinWillClose) {
  // The corner of a cube that spins in free space moves at 8 m/s; nothing else moves, and it weighs nothing.
  World<6> world({.gravity = Vec3::Zero(), .soft_steps = SoftSteps{.substeps = 4}});
  world.add_fixed_box(Vec3(1.03, 0, 0), Vec3(0.5, 0.5, 0.5));
  const int cube =
      world.add({.x = Vec3::Zero(), .mass = 1, .omega = Vec3(0, 0, 12), .half_sides = Vec3::Constant(0.5)});
  world.step(h);
  EXPECT_FALSE(world.contacts().empty());
  for (int n = 0; n < 30; ++n) {
    world.step(h);
    for (const Contact& contact : world.contacts()) EXPECT_GT(contact.gap, -0.05) << "step " << n;
  }
  EXPECT_LT(world.x(cube).x(), 0);
}

TEST(BetweenSteps, AStartLeavesOutWhatSeparates) {
  // Infinite viscosity leaves friction rows with Σ = 0, where Newton's method is not used.
  World<6> world({.friction = 0.5, .viscosity = infinity});
  world.add_plane(Vec3::UnitZ(), 0);
  Body<6> thrown = ball(Vec3(0, 0, 0.1));
  thrown.v = Vec3(0, 0, 3);
  const int n = world.add(thrown);
  world.start_consistently(h);
  EXPECT_NEAR(world.v(n).z(), 3 + g * h / 2, 1e-12);
}

TEST(BetweenSteps, SoftStepsKnowTheirLagBeforeTheFirst) {
  World<6> world({.soft_steps = SoftSteps{.substeps = 4}});
  EXPECT_DOUBLE_EQ(world.velocity_lag(h), h / 8);
  const int n = world.add(ball(Vec3(0, 0, 100)));
  world.place(n, Vec3(0, 0, 100), Vec3(0, 0, g * world.velocity_lag(h)));
  for (int step = 0; step < 60; ++step) world.step(h);
  EXPECT_NEAR(world.x(n).z(), 100 - g / 2, 1e-9);
}

TEST(BetweenSteps, TheTimeOfASpinMayBeZeroStepsAway) {
  World<6> world({});
  Body<6> spinning = ball(Vec3::Zero());
  spinning.omega = Vec3(1, 2, 3);
  const int n = world.add(spinning);
  EXPECT_EQ(world.synchronized_velocity(n, 0), world.v(n));
  EXPECT_EQ(world.synchronized_angular_velocity(n, 0), angular_velocity(world, n));
}

TEST(BetweenSteps, PointsOfADistanceThatMeetInALaterPartEndTheRun) {
  // Two masses on a spring meet after one of two substeps. It is so weak that their positions are exact.
  World<3> world({.gravity = Vec3::Zero(), .soft_steps = SoftSteps{.substeps = 2}});
  const int left = world.add({.x = Vec3(-h / 2, 0, 0), .v = Vec3(1, 0, 0), .mass = 1}),
            right = world.add({.x = Vec3(h / 2, 0, 0), .v = Vec3(-1, 0, 0), .mass = 1});
  world.add_joint({.i = left, .j = right, .length = h, .k = 1e-40});
  EXPECT_THROW(world.step(h), SimulationDiverged);
}

}  // namespace
}  // namespace spook::between_steps_test
