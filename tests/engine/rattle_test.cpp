// Steps of order four: their order, conserved quantities, and refused input.
#include <gtest/gtest.h>

#include <cmath>

#include "checks.hpp"
#include "engine/bodies/conserved_quantities.hpp"
#include "engine/diagnostics/run_check.hpp"
#include "engine/world/world.hpp"
#include "refusals.hpp"
#include "scene_runs.hpp"

namespace spook::rattle_test {
namespace {

using spook::testing::expect_order;

constexpr double epsilon = 2.2e-16;
constexpr double g = 9.81;

double rattle_error(const std::string& name, const SceneSettings& settings, double h, double time) {
  const SceneDescription& description = find_scene(name);
  const auto scene = description.build(with(description, settings),
                                       {.h = h, .solver = description.solver, .integrator_order = 4});
  for (std::int64_t n = step_count(h, time); n > 0; --n) {
    scene->advance(1);
    scene->observe();
    scene->judge();
  }
  EXPECT_EQ(scene->verdict().state, State::sound) << scene->verdict().reason;
  return scene->error();
}

void expect_order_four(const std::string& scene, const SceneSettings& settings, double h, double time) {
  expect_order(
      scene + ", error", "Eq. (1.13)", [&](double step) { return rattle_error(scene, settings, step, time); },
      h, 3, 4, 0.1);
}

// Order

TEST(Rattle, OrbitIsOfOrderFour) {
  expect_order_four("orbit", {}, 0.05, 10);
}

TEST(Rattle, OscillatorIsOfOrderFour) {
  expect_order_four("oscillator", {}, 0.02, 2);
}

TEST(Rattle, PendulumOfAPointIsOfOrderFour) {
  expect_order_four("pendulum", {{"d", "0"}, {"model", "point"}}, 0.02, 3);
}

TEST(Rattle, PendulumOfABodyIsOfOrderFour) {
  expect_order_four("pendulum", {{"d", "0"}, {"model", "body"}}, 0.02, 3);
}

TEST(Rattle, DoublePendulumIsOfOrderFour) {
  expect_order_four("double_pendulum", {{"d", "0"}}, 1.0 / 60, 2);
}

TEST(Rattle, DoublePendulumIsRightToThreeMicrometresAt60StepsASecond) {
  EXPECT_LT(2 * rattle_error("double_pendulum", {{"d", "0"}}, 1.0 / 60, 2), 3e-6);  // l1 + l2 = 2 m
}

/// Three boxes, each of three different moments, hung from each other by their corners, and spinning.
World<6> tumbling() {
  World<6> world({.gravity = Vec3(0, 0, -g), .integrator_order = 4});
  const Vec3 half(0.3, 0.1, 0.15);
  int above = world.add_fixed(Vec3::Zero());
  Vec3 hook = Vec3::Zero();
  for (int n = 0; n < 3; ++n) {
    const int box = world.add({.x = (2 * n + 1) * half,
                               .v = Vec3(0.2, -0.1, 0),
                               .mass = 1.0 + n,
                               .omega = Vec3(0.5 * n, 2, 1),
                               .principal = solid_box_moments(1.0 + n, half)});
    world.add_joint({.i = above, .j = box, .p_i = hook, .p_j = -half});
    above = box;
    hook = half;
  }
  return world;
}

Vec3 end_of_tumbling(double h, double time) {
  World<6> world = tumbling();
  for (std::int64_t n = step_count(h, time); n > 0; --n) world.step(h);
  return world.x(3);
}

TEST(Rattle, BodiesThatTurnAreOfOrderFour) {
  // Without a closed form: two steps of h/2 against one of h, whose difference falls as their error does.
  const auto difference = [](double h) {
    return (end_of_tumbling(h, 0.8) - end_of_tumbling(h / 2, 0.8)).norm();
  };
  expect_order("three boxes on ball joints, x(h) - x(h/2) [m]", "Eq. (1.13)", difference, 0.01, 3, 4, 0.15);
}

TEST(Rattle, TorquesThatChangeInTimeAreOfOrderFour) {
  // I θ'' = T cos t - c sin θ of a wheel with a spring that winds about it, against two halves of each step.
  const auto turned = [](double h) {
    World<6> world({.gravity = Vec3::Zero(),
                    .wrench = [](std::size_t, const Bodies<6>& bodies, double time) -> Twist<6> {
                      const Vec3 across = bodies.orientations.q[0] * Vec3::UnitX();
                      return (Twist<6>() << 0, 0, 0, 0, 0, std::cos(3 * time) - 4 * across.y()).finished();
                    },
                    .integrator_order = 4});
    world.add({.principal = Vec3(0.3, 0.4, 0.5)});
    for (std::int64_t n = step_count(h, 2); n > 0; --n) world.step(h);
    return Vec3(orientation(world, 0) * Vec3::UnitX());
  };
  const auto difference = [&](double h) { return (turned(h) - turned(h / 2)).norm(); };
  expect_order("a wheel that is driven to and fro, x(h) - x(h/2)", "Eq. (1.13)", difference, 0.1, 3, 4, 0.15);
}

TEST(Rattle, RowsThatRepeatEachOtherDoNotMatter) {
  // Two ball joints on one line leave a body one angle, and hold its place along the line twice.
  const auto swung = [](double h) {
    World<6> world({.gravity = Vec3(0, 0, -g), .integrator_order = 4});
    const int wall = world.add_fixed(Vec3::Zero());
    const Vec3 half(0.4, 0.2, 0.1);
    const int door = world.add({.x = Vec3(0.4, 0, 0), .principal = solid_box_moments(1, half)});
    for (const double along : {-0.2, 0.2})
      world.add_joint({.i = wall, .j = door, .p_i = along * Vec3::UnitY(), .p_j = Vec3(-0.4, along, 0)});
    for (std::int64_t n = step_count(h, 1); n > 0; --n) world.step(h);
    return world.x(door);
  };
  const auto difference = [&](double h) { return (swung(h) - swung(h / 2)).norm(); };
  expect_order("a flap on two ball joints, x(h) - x(h/2) [m]", "Eq. (1.13)", difference, 0.02, 3, 4, 0.15);
}

// Conserved quantities

/// Points on rods, from a static one, along x.
World<3> chain(int links) {
  World<3> world({.gravity = Vec3(0, 0, -g), .integrator_order = 4});
  int last = world.add_fixed(Vec3::Zero());
  for (int n = 1; n <= links; ++n) {
    const int point = world.add({.x = Vec3(n, 0, 0), .v = Vec3(0, 0.1 * n, 0), .mass = 1.0 + n % 3});
    world.add_joint({.i = last, .j = point, .length = 1});
    last = point;
  }
  return world;
}

TEST(Rattle, JointsAreHeldToRoundings) {
  for (const int links : {3, 30}) {  // the factors are dense, and sparse
    World<3> world = chain(links);
    for (int n = 0; n < 200; ++n) {
      world.step(0.01);
      ASSERT_TRUE(world.solved().converged) << "step " << n;
      for (const Joint& joint : world.joints()) {
        const Vec3 apart = world.x(joint.j) - world.x(joint.i);
        ASSERT_NEAR(apart.norm(), 1, 20 * epsilon * links) << "step " << n;
        // The last correction uses the present G, and leaves Σ's fraction of it: 1e-12 of some m/s.
        ASSERT_NEAR(apart.dot(world.v(joint.j) - world.v(joint.i)), 0, 1e-11) << "step " << n;
      }
    }
  }
}

TEST(Rattle, RunsBackToWhereItCameFrom) {
  World<6> world = tumbling();
  const std::vector<Vec3> x = world.bodies().x;
  for (int n = 0; n < 100; ++n) world.step(0.01);
  EXPECT_GT((world.x(3) - x[3]).norm(), 0.1) << "it should move";
  for (int body = 1; body <= 3; ++body) {
    world.place(body, world.x(body), -world.v(body));
    world.turn(body, orientation(world, body), -angular_velocity(world, body));
  }
  for (int n = 0; n < 100; ++n) world.step(0.01);
  for (std::size_t body = 1; body <= 3; ++body)
    EXPECT_LE((world.bodies().x[body] - x[body]).norm(), 1e-9) << "round-off, which grows in the chain";
}

TEST(Rattle, EnergyStaysInItsBand) {
  // Two points that swing by half a radian: not chaotic, so that no later swing is faster than the first few.
  World<3> world({.gravity = Vec3(0, 0, -g), .integrator_order = 4});
  int last = world.add_fixed(Vec3::Zero());
  for (int n = 1; n <= 2; ++n) {
    const int point = world.add({.x = n * Vec3(std::sin(0.5), 0, -std::cos(0.5))});
    world.add_joint({.i = last, .j = point, .length = 1});
    last = point;
  }
  const auto energy = [&] {
    return kinetic_energy(world.bodies()) + potential_energy(world.bodies(), Vec3(0, 0, -g));
  };
  const double first = energy(), h = 1.0 / 60,
               faster = std::sqrt((2 + std::sqrt(2.0)) * g);  // of its two swings
  double early = 0, all = 0;
  for (int n = 0; n < 60 * 200; ++n) {
    world.step(h);
    all = std::max(all, std::abs(energy() - first));
    if (n < 60 * 20) early = all;
  }
  EXPECT_LT(all, 1.2 * early) << "a drift would take it to ten times its width";
  EXPECT_LT(all, std::pow(h * faster, 4) * 3 * g * (1 - std::cos(0.5))) << "(h ω)⁴ of what swings";
}

TEST(Rattle, MomentumIsKept) {
  World<6> world({.gravity = Vec3::Zero(), .integrator_order = 4});
  const Vec3 half(0.3, 0.1, 0.15);
  for (int n = 0; n < 2; ++n)
    world.add({.x = Vec3(0.6 * n, 0, 0),
               .v = Vec3(0.1, 0.3 * n, 0),
               .mass = 1.0 + n,
               .omega = Vec3(1, 2.0 * n, 3),
               .principal = solid_box_moments(1.0 + n, half)});
  world.add_joint({.i = 0, .j = 1, .p_i = 0.3 * Vec3::UnitX(), .p_j = -0.3 * Vec3::UnitX()});
  world.step(0.01);  // the first brings the velocities to those that the joint allows
  const Vec3 p = momentum(world.bodies()), L = angular_momentum(world.bodies());
  const int steps = 1000;
  for (int n = 0; n < steps; ++n) world.step(0.01);
  EXPECT_LE((momentum(world.bodies()) - p).norm(), 50 * steps * epsilon);
  EXPECT_LE((angular_momentum(world.bodies()) - L).norm(), 50 * steps * epsilon);
}

TEST(Rattle, JointsTellTheMeanOfTheirForce) {
  World<3> world({.gravity = Vec3(0, 0, -g), .integrator_order = 4});
  world.add_fixed(Vec3::Zero());
  world.add({.x = Vec3(0, 0, -2), .mass = 3});
  world.add_joint({.i = 0, .j = 1, .length = 2});
  world.step(0.02);
  EXPECT_NEAR(world.joint_force(0).z(), 3 * g, 1e-10);
  EXPECT_NEAR(world.forces()[1].z(), -3 * g, 1e-12);
}

TEST(Rattle, VelocitiesAreOfTheTimeOfPositions) {
  World<3> world({.gravity = Vec3(0, 0, -g), .integrator_order = 4});
  world.add({});
  world.start_half_step_back(0.1);
  world.step(0.1);
  EXPECT_NEAR(world.x(0).z(), -g * 0.01 / 2, 1e-14);
  EXPECT_NEAR(world.v(0).z(), -g * 0.1, 1e-14);
  EXPECT_EQ(world.synchronized_velocity(0, 0.1), world.v(0));
}

// Unsolvable steps and refused input

TEST(Rattle, SaysWhenCorrectionsDoNotSuffice) {
  World<3> world({.gravity = Vec3(0, 0, -g), .integrator_order = 4, .solver_limits = {.max_sweeps = 1}});
  world.add_fixed(Vec3::Zero());
  world.add({.x = Vec3(1, 0, 0), .v = Vec3(0, 0, 3)});
  world.add_joint({.i = 0, .j = 1, .length = 1});
  world.step(0.2);
  EXPECT_FALSE(world.solved().converged);
  EXPECT_GT(world.report().residual, 0);
}

TEST(Rattle, RefusesWhatHasNoWayBack) {
  using Points = World<3>;
  using Solids = World<6>;
  expect_refusal({"integrator_order", "2 or 4", "3"}, [] { Points world({.integrator_order = 3}); });
  expect_refusal({"d must be 0", "integrator_order 4", "2"},
                 [] { Points world({.d = 2, .integrator_order = 4}); });
  Points braked({.wrench = [](std::size_t i, const Bodies<3>& bodies, double) -> Twist<3> {
                   return -0.1 * bodies.motion.W[i];
                 },
                 .integrator_order = 4});
  braked.add({});
  expect_refusal({"integrator_order", "wrench", "velocities"}, [&] { braked.step(0.1); });
  for (const RotationUpdate update : {RotationUpdate::first_order, RotationUpdate::exponential})
    expect_refusal({"integrator_order", "rotation", "symmetric"},
                   [&] { Solids world({.rotation = {.update = update}, .integrator_order = 4}); });

  Solids world({.integrator_order = 4});
  const int ball = world.add({.radius = 0.5});  // a single body touches nothing
  expect_refusal({"integrator_order", "touch"}, [&] { world.add_plane(Vec3::UnitZ(), 0); });
  Solids others({.integrator_order = 4});
  others.add({.radius = 0.5});
  expect_refusal({"integrator_order", "touch"}, [&] { others.add({.x = Vec3(2, 0, 0), .radius = 0.5}); });
  Solids joined({.integrator_order = 4});
  const int wall = joined.add_fixed(Vec3::Zero());
  joined.add({.radius = 0.5});
  expect_refusal({"d must be 0", "integrator_order 4"},
                 [&] { joined.add_joint({.i = wall, .j = ball + 1, .d = 1}); });
  const auto hinge = [&] { return Joint{.i = wall, .j = ball + 1, .kind = JointKind::hinge}; };
  Joint limited = hinge(), driven = hinge();
  limited.limits = JointLimits{.lower = -1, .upper = 1};
  driven.motor = Motor{.speed = 1};
  expect_refusal({"integrator_order", "limit", "smooth"}, [&] { joined.add_joint(limited); });
  expect_refusal({"integrator_order", "motor"}, [&] { joined.add_joint(driven); });
  const int free = joined.add_joint(hinge());
  expect_refusal({"integrator_order", "motor"}, [&] { joined.set_motor(free, driven.motor); });
}

}  // namespace
}  // namespace spook::rattle_test
