// Ropes: a largest distance, which pulls when it is taut.
#include <gtest/gtest.h>

#include <cmath>

#include "engine/diagnostics/run_check.hpp"
#include "engine/world/world.hpp"
#include "refusals.hpp"

namespace spook::rope_test {
namespace {

constexpr double g = 9.81;
constexpr double steps_to_try[] = {1.0 / 30, 1.0 / 60, 1.0 / 240, 1.0 / 1000};

/// A ball on a rope, or on a rod, of 1 m below the origin.
template <int Dof>
struct Hanging {
  World<Dof> world;
  RunCheck<Dof> check;

  Hanging(const Vec3& x, JointKind kind, const Vec3& v = Vec3::Zero()) : world({}) {
    world.add_fixed(Vec3::Zero());
    Body<Dof> ball{.x = x, .v = v, .mass = 2};
    if constexpr (Dof == 6) ball.principal = Vec3::Ones();
    world.add(ball);
    world.add_joint({.i = 0, .j = 1, .length = 1, .kind = kind});
  }
  void step(double h) {
    check.look(world, h);
    world.step(h);
    check.look(world, h);
    EXPECT_EQ(check.verdict().state, State::sound) << check.verdict().reason;
  }
  double energy(double h) const {
    return world.synchronized_velocity(1, h).squaredNorm() / 2 + g * world.x(1).z();
  }
};

template <int Dof>
void falls_freely_while_slack() {
  for (const double h : steps_to_try) {
    Hanging<Dof> rope(Vec3(0, 0, -0.1), JointKind::rope);
    Hanging<Dof> free(Vec3(0, 0, -0.1), JointKind::rope);
    free.world.remove_joint(0);
    const double caught = std::sqrt(2 * 0.9 / g);
    while (rope.world.time() < caught - 2 * h) {
      rope.step(h);
      free.step(h);
      ASSERT_EQ(rope.world.x(1), free.world.x(1)) << "h = " << h;
      ASSERT_EQ(rope.world.joint_force(0), Vec3::Zero());
    }
  }
}

TEST(Ropes, FallFreelyWhileSlack) {
  falls_freely_while_slack<3>();
  falls_freely_while_slack<6>();
}

TEST(Ropes, CatchWithoutRebound) {
  for (const double h : steps_to_try) {
    Hanging<6> rope(Vec3(0, 0, -0.1), JointKind::rope);
    double lowest = 0, highest_after = -2;
    while (rope.world.time() < 3) {
      rope.step(h);
      const double z = rope.world.x(1).z();
      lowest = std::min(lowest, z);
      if (rope.world.time() > std::sqrt(2 * 0.9 / g) + 2 * h) highest_after = std::max(highest_after, z);
    }
    EXPECT_GE(lowest, -1 - 1e-4) << "h = " << h;
    EXPECT_LE(highest_after, -1 + 1e-6) << "h = " << h;
    EXPECT_NEAR(rope.world.joint_force(0).z(), 2 * g, 1e-6 * g) << "h = " << h;
  }
}

TEST(Ropes, CaughtBallSwingsAsAPendulum) {
  // At (0.6, -0.8) the rope removes the radial part of √(2 g 0.8). 0.6 of it remains, and v² = 2 g (0.36 0.8 + 0.2)
  // below.
  const double lowest_speed = std::sqrt(2 * g * (0.36 * 0.8 + 0.2));
  std::vector<double> errors;
  for (const double h : {1.0 / 120, 1.0 / 960}) {
    Hanging<3> rope(Vec3(0.6, 0, 0), JointKind::rope);
    double energy = rope.energy(h), grown = 0, fastest = 0;
    while (rope.world.time() < 1.2) {
      rope.step(h);
      grown = std::max(grown, rope.energy(h) - energy);
      energy = std::min(energy, rope.energy(h));
      if (std::abs(rope.world.x(1).x()) < 0.05) fastest = std::max(fastest, rope.world.v(1).norm());
      ASSERT_LE(rope.world.x(1).norm(), 1 + 1e-2);
    }
    EXPECT_LE(grown, 2 * g * g * h * h) << "h = " << h;
    errors.push_back(std::abs(fastest - lowest_speed));
    EXPECT_LE(errors.back(), lowest_speed * h * 4) << "h = " << h;
  }
}

TEST(Ropes, TautRopeIsARod) {
  for (const double h : {1.0 / 60, 1.0 / 240}) {
    const double angle = 0.5;
    const Vec3 x(std::sin(angle), 0, -std::cos(angle));
    Hanging<3> rope(x, JointKind::rope), rod(x, JointKind::distance);
    double apart = 0;
    while (rope.world.time() < 2) {
      rope.step(h);
      rod.step(h);
      apart = std::max(apart, (rope.world.x(1) - rod.world.x(1)).norm());
    }
    EXPECT_LE(apart, 20 * h * h) << "h = " << h;
    EXPECT_NEAR(rope.world.joint_force(0).norm(), rod.world.joint_force(0).norm(), g * h) << "h = " << h;
  }
}

TEST(Ropes, GoSlackAboveTheCircle) {
  // With v² = 3 g l below, a ball on a rope leaves the circle at the height l/3, and then flies freely.
  const double h = 1.0 / 960;
  Hanging<3> rope(Vec3(0, 0, -1), JointKind::rope, Vec3(std::sqrt(3 * g), 0, 0));
  while (rope.world.joint_force(0).norm() > 0 || rope.world.time() < 0.1) {
    rope.step(h);
    ASSERT_LT(rope.world.time(), 2);
  }
  EXPECT_NEAR(rope.world.x(1).z(), 1.0 / 3, 20 * h);
  EXPECT_NEAR(rope.world.v(1).squaredNorm(), g / 3, 0.05 * g / 3);
}

TEST(Ropes, TowWhatFollows) {
  // Momentum: 1 kg at 3 m/s pulls 2 kg along at 1 m/s.
  World<3> world({.gravity = Vec3::Zero()});
  world.add({.v = Vec3(3, 0, 0), .mass = 1});
  world.add({.x = Vec3(0.2, 0, 0), .mass = 2});
  world.add_joint({.i = 0, .j = 1, .length = 1.5, .kind = JointKind::rope});
  for (int n = 0; n < 120; ++n) world.step(1.0 / 60);
  EXPECT_NEAR(world.v(0).x(), 1, 1e-6);
  EXPECT_NEAR(world.v(1).x(), 1, 1e-6);
  EXPECT_NEAR(world.x(0).x() - world.x(1).x(), 1.5, 1e-3);
}

TEST(Ropes, MayBeginWhereTheirEndsCoincide) {
  Hanging<6> rope(Vec3::Zero(), JointKind::rope);
  while (rope.world.time() < 2) rope.step(1.0 / 60);
  EXPECT_NEAR(rope.world.x(1).z(), -1, 1e-4);
}

TEST(Ropes, HoldWithEverySolver) {
  for (const NamedSolver<3>& named : solvers<3>()) {
    World<3> world({.solver = named.make_on_box(), .solver_limits = {.max_sweeps = 200}});
    world.add_fixed(Vec3::Zero());
    for (int n = 1; n <= 3; ++n) {
      world.add({.x = Vec3(0.1 * n, 0, 0), .mass = 1});
      world.add_joint({.i = n - 1, .j = n, .length = 0.5, .kind = JointKind::rope});
    }
    for (int n = 0; n < 240; ++n) world.step(1.0 / 120);
    for (int n = 1; n <= 3; ++n) EXPECT_LE((world.x(n) - world.x(n - 1)).norm(), 0.51) << named.name;
    EXPECT_LE(world.x(3).z(), -1.2) << named.name;
  }
}

TEST(Ropes, RefuseWhatIsNoRope) {
  Hanging<6> rope(Vec3(0, 0, -0.5), JointKind::rope);
  const auto add = [&](Joint joint) {
    joint.kind = JointKind::rope;
    rope.world.add_joint(joint);
  };
  expect_refusal({"kind", "rope"}, [&] { add({.i = 0, .j = 1}); });
  expect_refusal({"length", "0"}, [&] { add({.i = 0, .j = 1, .length = 0}); });
  expect_refusal({"length", "-1"}, [&] { add({.i = 0, .j = 1, .length = -1}); });
  expect_refusal({"limit_d", "-1"}, [&] { add({.i = 0, .j = 1, .length = 1, .limit_d = -1}); });
  World<3> smooth({.integrator_order = 4});
  smooth.add_fixed(Vec3::Zero());
  smooth.add({.x = Vec3(0, 0, -1), .mass = 1});
  expect_refusal({"integrator_order", "rope"},
                 [&] { smooth.add_joint({.i = 0, .j = 1, .length = 1, .kind = JointKind::rope}); });
}

}  // namespace
}  // namespace spook::rope_test
