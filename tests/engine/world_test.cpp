// The settings and queries of a world beside its steps: materials, wrenches, states, forces, starts.
#include "engine/world/world.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "checks.hpp"
#include "engine/bodies/conserved_quantities.hpp"
#include "refusals.hpp"

namespace spook::world_test {
namespace {

constexpr double h = 1.0 / 60, g = 9.81, epsilon = 2.2e-16;

void step(auto& world, int steps) {
  for (int n = 0; n < steps; ++n) world.step(h);
}

// Materials

TEST(Materials, OfTwoBodiesAreTheRulesOfTheHeader) {
  Materials materials({.friction = 0.5, .restitution = 0.1, .k = 1e6, .d = 3});
  EXPECT_FALSE(materials.any());
  EXPECT_EQ(materials.of(0, 7).friction, 0.5);
  materials.set(1, {.friction = 0.08, .restitution = 0.7, .k = 1e4});
  materials.set(2, {.friction = 0.0, .d = 5.0});
  const PairMaterial mixed = materials.of(1, 3), smooth = materials.of(2, 1);
  EXPECT_DOUBLE_EQ(mixed.friction, std::sqrt(0.5 * 0.08));
  EXPECT_EQ(mixed.restitution, 0.7);
  EXPECT_EQ(mixed.k, 1e4);
  EXPECT_EQ(mixed.d, 3);
  EXPECT_EQ(smooth.friction, 0);
  EXPECT_EQ(smooth.d, 5);
  materials.set(3, 1, {.friction = 0.9});
  EXPECT_EQ(materials.of(1, 3).friction, 0.9) << "of the pair, in either order";
  EXPECT_EQ(materials.of(1, 3).k, 1e4) << "and for the rest of the bodies";
  materials.remove(0);
  EXPECT_EQ(materials.of(0, 2).friction, 0.9) << "the former 1 and 3";
  EXPECT_EQ(materials.of(1, 0).friction, 0);
  expect_refusal({"friction", "-1"}, [&] { materials.set(0, {.friction = -1.0}); });
  expect_refusal({"restitution", "2"}, [&] { materials.set(0, {.restitution = 2.0}); });
  expect_refusal({"k", "0"}, [&] { materials.set(0, {.k = 0.0}); });
  expect_refusal({"d", "-1"}, [&] { materials.set(0, 1, {.d = -1.0}); });
}

TEST(Materials, DecideWhoSlidesWhoBouncesAndHowDeep) {
  World<3> world({.k = 1e6});  // smooth, of e = 0
  const int floor = world.add_plane(Vec3::UnitZ(), 0);
  const auto ball = [&](double y, double z, double vx) {
    return world.add({.x = Vec3(0, y, z), .v = Vec3(vx, 0, 0), .radius = 0.1});
  };
  const int smooth = ball(0, 0.1, 1), rough = ball(1, 0.1, 1), bouncy = ball(2, 1.1, 0), soft = ball(3, 0.1, 0);
  world.set_material(floor, rough, {.friction = 0.5});
  world.set_material(bouncy, {.restitution = 1.0});
  world.set_material(soft, {.k = 1e3});
  step(world, 240);
  EXPECT_NEAR(world.v(smooth).x(), 1, 1e-12);
  EXPECT_NEAR(world.v(rough).x(), 0, 1e-9) << "v²/(2μg) is 0.1 m";
  EXPECT_NEAR(world.x(rough).x(), 1 / (2 * 0.5 * g), h) << "and a step of it";
  const double v = world.synchronized_velocity(bouncy, h).z();
  EXPECT_NEAR(world.x(bouncy).z() - 0.1 + v * v / (2 * g), 1 + g * h * h / 8, 1e-9)
      << "1 m, and the part of a start with v = 0 half a step before";
  EXPECT_NEAR(world.x(soft).z() - 0.1, -g / 1e3, 1e-9);
  EXPECT_NEAR(world.x(smooth).z() - 0.1, -g / 1e6, 1e-9);
}

TEST(Synchronized, IsTheVelocityAtThePosition) {
  // A pendulum, and what rests or hangs. Its v, half a step old, is of first order.
  World<6> resting({.gravity = Vec3(0, 0, -g)});
  resting.add_plane(Vec3::UnitZ(), 0);
  const int ball = resting.add({.x = Vec3(0, 0, 0.1), .radius = 0.1});
  const int nail = resting.add_fixed(Vec3(5, 0, 1)), lamp = resting.add({.x = Vec3(5, 0, 0.5), .radius = 0.1});
  resting.add_joint({.i = nail, .j = lamp, .length = 0.5});
  step(resting, 240);
  EXPECT_NEAR(resting.synchronized_velocity(ball, h).z(), 0, 1e-9) << "a ball at rest";
  EXPECT_NEAR(resting.synchronized_velocity(lamp, h).z(), 0, 1e-9) << "a lamp at rest";
  EXPECT_THROW(static_cast<void>(resting.synchronized_velocity(ball, -1)), std::invalid_argument);

  const auto off = [](double step) {
    World<6> swinging({.gravity = Vec3(0, 0, -g)});
    const int pivot = swinging.add_fixed(Vec3::Zero()), bob = swinging.add({.x = Vec3(1, 0, 0), .radius = 0.1});
    swinging.add_joint({.i = pivot, .j = bob, .length = 1});
    swinging.start_half_step_back(step);
    const double from = g * swinging.x(bob).z();
    double most = 0;
    while (swinging.time() < 1) {
      swinging.step(step);
      const double energy =
          swinging.synchronized_velocity(bob, step).squaredNorm() / 2 + g * swinging.x(bob).z();
      most = std::max(most, std::abs(energy - from));
    }
    return most / g;
  };
  testing::expect_order("energy of a pendulum with the synchronized velocity", "", off, 0.02, 4, 2, 0.3);
}

// Wrenches

TEST(Wrench, SeesVelocityAndTime) {
  // Drag c v is of first order, as v is half a step behind; a force of time alone is of second.
  const auto fallen = [](double step) {
    World<3> world({.wrench = [](std::size_t i, const Bodies<3>& bodies, double) -> Twist<3> {
      return -2 * bodies.motion.W[i];
    }});
    world.add({.mass = 0.5});
    for (int n = 0; n < std::lround(1 / step); ++n) world.step(step);
    return std::abs(world.v(0).z() + g / 4 * (1 - std::exp(-4.0)));
  };
  testing::expect_order("speed of a fall with drag", "", fallen, 0.05, 4, 1, 0.2);
  World<3> pushed({.gravity = Vec3::Zero(),
                   .wrench = [](std::size_t, const Bodies<3>&, double t) { return Twist<3>(t, 0, 0); }});
  pushed.add({});
  for (int n = 0; n < 100; ++n) pushed.step(0.01);
  EXPECT_NEAR(pushed.v(0).x(), 0.5 * 0.99, 1e-12) << "Σ h (n h), n below 100";
}

TEST(Wrench, TurnsWhatItTwists) {
  const Vec3 torque(0, 0, 3);
  World<6> world({.gravity = Vec3::Zero(), .wrench = [&](std::size_t, const Bodies<6>&, double) {
                    Twist<6> wrench;
                    wrench << Vec3::Zero(), torque;
                    return wrench;
                  }});
  world.add({.principal = Vec3(1, 1.5, 2)});
  world.start_half_step_back(h);
  step(world, 60);
  EXPECT_NEAR(world.synchronized_angular_velocity(0, h).z(), 1.5 * 1, 1e-12) << "τ t/I";
  EXPECT_LE((angular_momentum(world.bodies()) - torque * (1 - h / 2)).norm(), 1e-12);
  expect_refusal({"gravity", "box"}, [] {
    World<6>({.gravity = Vec3::Zero(),
              .wrench = [](std::size_t, const Bodies<6>&, double) { return Twist<6>(Twist<6>::Zero()); },
              .friction = 0.5,
              .solver = direct<6>()});
  });
}

// Bodies

TEST(Bodies, HaveTheMomentsOfTheirShapeOrGivenOnes) {
  World<6> world({});
  const int ball = world.add({.mass = 3, .radius = 0.2}),
            box = world.add({.mass = 2, .half_sides = Vec3(1, 2, 3)});
  EXPECT_EQ(world.bodies().orientations.principal[world.index(ball)], solid_sphere_moments(3, 0.2));
  EXPECT_EQ(world.bodies().orientations.principal[world.index(box)], solid_box_moments(2, Vec3(1, 2, 3)));
  expect_refusal({"principal moments", "missing"}, [&] { world.add({}); });
  expect_refusal({"principal moment", "3.1", "other two"}, [&] { world.add({.principal = Vec3(1, 3.1, 2)}); });
  world.add({.principal = Vec3(1, 3, 2)});  // a flat one: equal
}

TEST(Bodies, AFixedBoxHoldsWhatLiesOnIt) {
  World<6> world({.friction = 0.5});
  const double tilt = 0.3;  // below atan 0.5
  const Quat q(Eigen::AngleAxisd(tilt, Vec3::UnitY()));
  world.add_fixed_box(Vec3::Zero(), Vec3(2, 2, 0.5), q);
  const int box = world.add({.x = q * Vec3(0, 0, 0.6), .q = q, .half_sides = Vec3(0.1, 0.1, 0.1)});
  const Vec3 start = world.x(box);
  step(world, 120);
  EXPECT_LE((world.x(box) - start).norm(), 1e-4) << "it sinks by its weight over k, and creeps no further";
  EXPECT_EQ(world.contacts().size(), 4U);
  expect_refusal({"half side", "0"}, [&] { world.add_fixed_box(Vec3::Zero(), Vec3(1, 0, 1)); });
}

TEST(Bodies, ThatAreTakenOutLeaveTheWorldThatWouldBeWithoutThem) {
  const auto build = [](bool with_extra) {
    World<6> world({});
    world.add_plane(Vec3::UnitZ(), 0);
    if (with_extra) world.add({.x = Vec3(5, 0, 0.1), .radius = 0.1});
    const int a = world.add({.x = Vec3(0, 0, 1), .radius = 0.1}),
              b = world.add({.x = Vec3(1, 0, 1), .radius = 0.1});
    if (with_extra) world.add_joint({.i = 1, .j = a, .length = 5.1});
    world.add_joint({.i = a, .j = b, .length = 1});
    world.set_material(b, {.restitution = 0.5});
    if (with_extra) world.remove_body(1);
    return world;
  };
  World<6> without = build(false), taken = build(true);
  ASSERT_EQ(taken.joints().size(), 1U);
  step(without, 200);
  step(taken, 200);
  for (int body = 1; body <= 2; ++body) EXPECT_EQ(without.x(body), taken.x(body));
  expect_refusal({"body", "9"}, [&] { taken.remove_body(9); });
}

TEST(Bodies, ArePlacedAndTurned) {
  World<6> world({.gravity = Vec3::Zero()});
  world.add_plane(Vec3::UnitZ(), -10);
  const int body = world.add({.radius = 0.1});
  const Quat q(Eigen::AngleAxisd(1, Vec3::UnitX()));
  world.place(body, Vec3(1, 2, 3), Vec3(0, 1, 0));
  world.turn(body, q, Vec3(0, 0, 2));
  EXPECT_TRUE(orientation(world, body).isApprox(q));
  step(world, 60);
  EXPECT_LE((world.x(body) - Vec3(1, 3, 3)).norm(), 1e-13);
  EXPECT_LE((angular_velocity(world, body) - Vec3(0, 0, 2)).norm(), 1e-13);
  expect_refusal({"body", "0"}, [&] { world.place(0, Vec3::Zero(), Vec3::Zero()); });
  expect_refusal({"q", "2"}, [&] { world.turn(body, Quat(2, 0, 0, 0), Vec3::Zero()); });
  expect_refusal({"h", "-1"}, [&] { (void)world.velocity_lag(-1); });
  expect_refusal({"h", "nan"}, [&] { (void)world.stop_rule(std::nan("")); });
}

// Constraints

TEST(Forces, OfJointsAndContactsCarryTheWeight) {
  World<6> world({});
  world.add_plane(Vec3::UnitZ(), 0);
  const int hook = world.add_fixed(Vec3(0, 0, 3));
  const int hung = world.add({.x = Vec3(0, 0, 2), .mass = 2, .radius = 0.1});
  world.add({.x = Vec3(1, 0, 0.1), .mass = 3, .radius = 0.1});
  const int rod = world.add_joint({.i = hook, .j = hung, .length = 1});
  const int ball = world.add_joint({.i = hook, .j = hung, .p_i = Vec3(0, 0, -1), .k = 1e5});
  EXPECT_EQ(world.joint_force(rod), Vec3::Zero()) << "no step yet";
  step(world, 600);
  EXPECT_LE((world.joint_force(rod) + world.joint_force(ball) - Vec3(0, 0, 2 * g)).norm(), 1e-6);
  EXPECT_LE((world.contact_force(0) - Vec3(0, 0, 3 * g)).norm(), 1e-6);
  EXPECT_NEAR(potential_energy(world.bodies(), Vec3(0, 0, -g)),
              2 * g * world.x(hung).z() + 3 * g * world.x(3).z(), 1e-12);
}

// Starts

/// The position after a second of a box of 1 m that hangs by the middle of a face, from an angle and 2 rad/s. In motion
/// its joint carries a part of the weight that it does not carry at rest, and only that part turns the box.
Vec3 swung(double step, bool consistently) {
  World<6> world({.k = 1e12, .d = 0.25, .solver = direct<6>()});
  const int hook = world.add_fixed(Vec3::Zero());
  const Quat q(Eigen::AngleAxisd(0.7, Vec3::UnitY()));
  const Vec3 omega(0, 2, 0), x = q * Vec3(0, 0, -0.5);
  const int box =
      world.add({.x = x, .v = omega.cross(x), .q = q, .omega = omega, .half_sides = Vec3(0.2, 0.2, 0.5)});
  world.add_joint({.i = hook, .j = box, .p_j = Vec3(0, 0, 0.5)});
  if (consistently)
    world.start_consistently(step);
  else
    world.start_half_step_back(step);
  for (int n = 0; n < std::lround(1 / step); ++n) world.step(step);
  return world.x(box);
}

TEST(Starts, AConsistentOneIsOfSecondOrderWithAConstraint) {
  const Vec3 limit = (4 * swung(1.0 / 12800, true) - swung(1.0 / 6400, true)) / 3;
  const auto consistent = [&](double step) { return (swung(step, true) - limit).norm(); };
  const auto by_weight_alone = [&](double step) { return (swung(step, false) - limit).norm(); };
  testing::expect_order("swinging box, consistent start", "", consistent, 1.0 / 100, 4, 2, 0.15);
  testing::expect_order("swinging box, its weight alone", "", by_weight_alone, 1.0 / 400, 4, 1, 0.15);
}

TEST(Starts, WhatSlipsIsBrakedFromTheStart) {
  // A point with 3 m/s on a floor with μ = 0.5 stops after v²/(2μg), to the last step. With the box it is short by half
  // a step of its speed if friction is not in its start. On the cone the first step compensates, since its normal force
  // stops half of the weight's speed.
  const auto stops = [](double step, bool consistently, FrictionModel model) {
    World<3> world({.friction = 0.5, .solver = automatic<3>(model)});
    world.add_plane(Vec3::UnitZ(), 0);
    const int ball = world.add({.x = Vec3(0, 0, 0.1 - g / 1e6), .v = Vec3(3, 0, 0), .radius = 0.1});
    if (consistently)
      world.start_consistently(step);
    else
      world.start_half_step_back(step);
    for (int n = 0; n < std::lround(1 / step); ++n) world.step(step);
    return world.x(ball).x() - 9 / (2 * 0.5 * g);
  };
  for (const double step : {1.0 / 60, 1.0 / 600}) {
    for (const FrictionModel model : {FrictionModel::box, FrictionModel::cone})
      EXPECT_LE(std::abs(stops(step, true, model)), 0.5 * g * step * step) << step << name_of(model);
    EXPECT_NEAR(stops(step, false, FrictionModel::box), -3 * step / 2, 0.5 * g * step * step) << step;
    EXPECT_LE(std::abs(stops(step, false, FrictionModel::cone)), 0.5 * g * step * step) << step;
  }
}

TEST(Starts, WhatRestsDoesNotMove) {
  World<6> world({.friction = 0.5});
  world.add_plane(Vec3::UnitZ(), 0);
  const int ball = world.add({.x = Vec3(0, 0, 0.1), .radius = 0.1});
  world.start_consistently(h);
  EXPECT_LE(world.v(ball).norm(), 1e-3 * g * h) << "Σ yields a little";
  EXPECT_LE(angular_velocity(world, ball).norm(), 1e-12);
  expect_refusal({"once"}, [&] { world.start_half_step_back(h); });
  expect_refusal({"once"}, [&] { world.start_consistently(h); });
}

}  // namespace
}  // namespace spook::world_test
