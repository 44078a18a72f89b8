// Default stiffness: standing and hanging bodies yield by less than a thousandth of their size, at any size and mass.
#include <gtest/gtest.h>

#include <cmath>

#include "engine/diagnostics/run_check.hpp"
#include "engine/world/world.hpp"
#include "refusals.hpp"

namespace spook::default_stiffness_test {
namespace {

constexpr double g = 9.81;

/// Returns the verdict after so many steps.
template <int Dof>
Verdict run(World<Dof>& world, double h, int steps) {
  RunCheck<Dof> check;
  for (int n = 0; n < steps; ++n) {
    world.step(h);
    check.look(world, h);
  }
  return check.verdict();
}

TEST(DefaultStiffness, LetsNothingSinkInAtAnySizeAndMass) {
  // Concrete cubes with sides from 20 µm to 200 m. The steps are a small part of the time to fall by that side.
  for (const double half : {1e-5, 1e-3, 0.1, 5.0, 100.0}) {
    const double mass = 2400 * 8 * half * half * half;
    const double h = std::min(1.0 / 60, 0.3 * std::sqrt(half / g));
    World<6> world({.friction = 0.5});
    world.add_plane(Vec3::UnitZ(), 0);
    const int cube = world.add({.x = Vec3(0, 0, half), .mass = mass, .half_sides = Vec3::Constant(half)});
    const Verdict verdict = run(world, h, 200);
    EXPECT_EQ(verdict.state, State::sound) << verdict.reason;
    EXPECT_EQ(verdict.note, "");
    EXPECT_NEAR(world.x(cube).z(), half, 1e-3 * half);
    EXPECT_LE(world.v(cube).norm(), 1e-6 * g * h);
  }
}

TEST(DefaultStiffness, HoldsTheHeaviestLoadOnTheLightestPart) {
  for (const double ratio : {1e-4, 1.0, 1e4}) {
    World<6> world({.friction = 0.5});
    world.add_plane(Vec3::UnitZ(), 0);
    const int below = world.add({.x = Vec3(0, 0, 0.05), .mass = 0.1, .half_sides = Vec3(0.2, 0.2, 0.05)});
    const int above = world.add({.x = Vec3(0, 0, 0.2), .mass = 0.1 * ratio, .half_sides = Vec3::Constant(0.1)});
    const Verdict verdict = run(world, 1.0 / 60, 300);
    EXPECT_EQ(verdict.state, State::sound) << verdict.reason << ", ratio " << ratio;
    EXPECT_EQ(verdict.note, "");
    for (const auto& [body, z] : {std::pair(below, 0.05), {above, 0.2}})
      EXPECT_LE((world.x(body) - Vec3(0, 0, z)).norm(), 2e-3 * 0.05) << "ratio " << ratio;
  }
}

TEST(DefaultStiffness, HangsAMillionKilogramsOnARod) {
  for (const double mass : {1e-3, 1.0, 1e6})
    for (const double h : {1.0 / 30, 1.0 / 1000}) {
      World<3> world({});
      world.add_fixed(Vec3::Zero());
      const int load = world.add({.x = Vec3(0, 0, -1), .mass = mass});
      world.add_joint({.i = 0, .j = load, .length = 1});
      EXPECT_EQ(run(world, h, 300).state, State::sound);
      EXPECT_NEAR(world.x(load).z(), -1, 1e-6) << mass << " kg, h " << h;
    }
}

TEST(DefaultStiffness, IsTheSameInAnyUnits) {
  // The same scene in metres and in millimetres, in kilograms and in tonnes: all lengths, forces and stiffnesses scale.
  const auto k_of = [](double length, double mass) {
    World<6> world({.gravity = Vec3(0, 0, -g * length)});
    world.add_plane(Vec3::UnitZ(), 0);
    world.add({.x = Vec3(0, 0, 0.1 * length), .mass = mass, .radius = 0.1 * length});
    world.add({.x = Vec3(0, 0, 0.3 * length), .mass = 2 * mass, .radius = 0.1 * length});
    world.step(1.0 / 60);
    return world.contact_stiffness();
  };
  EXPECT_NEAR(k_of(1000, 1) / k_of(1, 1), 1, 1e-12) << "N/m has no metre: kg/s²";
  EXPECT_NEAR(k_of(1, 1e-3) / k_of(1, 1), 1e-3, 1e-15);
}

TEST(DefaultStiffness, RefusesForcesThatGiveNone) {
  double force = 1e308;
  World<6> world({.force = [&](std::size_t, const std::vector<Vec3>&) { return Vec3(force, 0, 0); }});
  world.add_plane(Vec3::UnitZ(), 0);
  world.add({.x = Vec3(0, 0, 0.1), .mass = 1, .radius = 0.1});
  expect_refusal({"sum of all forces", "k given"}, [&] { world.step(1.0 / 60); });
  force = 0;
  world.step(1.0 / 60);
  EXPECT_EQ(world.steps(), 1);
  EXPECT_LT(world.contact_stiffness(), 1e7) << "the refused force leaves no trace";
}

TEST(DefaultStiffness, NamesTheStepAndTheSizeThatGiveNone) {
  World<3> rod({});
  rod.add_fixed(Vec3::Zero());
  rod.add({.x = Vec3(1, 0, 0)});
  rod.add_joint({.i = 0, .j = 1, .length = 1});
  expect_refusal({"h must be so long", "k given"}, [&] { rod.step(1e-200); });
  World<6> point({});
  point.add_plane(Vec3::UnitZ(), 0);
  point.add({.principal = Vec3(1, 1, 1), .corners = {Vec3::Zero()}});
  expect_refusal({"size of a body must be positive", "k given", "0"}, [&] { point.step(1.0 / 60); });
}

TEST(DefaultStiffness, GivesWayToAnyThatIsSaid) {
  World<6> world({.k = 1e4});
  world.add_plane(Vec3::UnitZ(), 0);
  const int ball = world.add({.x = Vec3(0, 0, 0.1), .mass = 1, .radius = 0.1});
  const int held = world.add({.x = Vec3(3, 0, 1), .mass = 1, .radius = 0.1});
  const int nail = world.add_fixed(Vec3(3, 0, 2));
  world.add_joint({.i = nail, .j = held, .length = 1, .k = 2e4});
  run(world, 1.0 / 60, 600);
  EXPECT_NEAR(world.x(ball).z(), 0.1 - g / 1e4, 1e-9);
  EXPECT_NEAR(world.x(held).z(), 1 - g / 2e4, 1e-9);
}

TEST(DefaultStiffness, FollowsWhatMotorsAndSpringsPressWith) {
  // A slider presses a cube of 1 kg on the floor with 10⁴ N, by a motor or a spring. A strong spring on a hinge needs more
  // parts in the first step, which is taken again.
  for (const bool motor : {true, false})
    for (const double h : {1.0 / 30, 1.0 / 240}) {
      World<6> world({});
      world.add_plane(Vec3::UnitZ(), 0);
      const int frame = world.add_fixed(Vec3(0, 0, 2));
      const int cube = world.add({.x = Vec3(0, 0, 0.1), .mass = 1, .half_sides = Vec3::Constant(0.1)});
      Joint press{.i = frame, .j = cube, .kind = JointKind::slider};
      press.p_i = Vec3(0, 0, -1.9);
      if (motor)
        press.motor = Motor{.speed = -1, .strength = 1e4};
      else
        press.spring = Spring{.stiffness = 1e5, .rest = -0.1};
      world.add_joint(press);
      const int hung = world.add_fixed(Vec3(5, 0, 3));
      const int arm = world.add({.x = Vec3(5.5, 0, 3), .mass = 1, .half_sides = Vec3(0.5, 0.1, 0.1)});
      world.add_joint({.i = hung,
                       .j = arm,
                       .p_j = Vec3(-0.5, 0, 0),
                       .kind = JointKind::hinge,
                       .axis = Vec3::UnitY(),
                       .spring = Spring{.stiffness = 1e4, .rest = 1}});
      for (int n = 0; n < 1 / h; ++n) world.step(h);
      EXPECT_NEAR(world.x(cube).z(), 0.1, 1e-4) << (motor ? "motor" : "spring") << ", h " << h;
    }
}

}  // namespace
}  // namespace spook::default_stiffness_test
