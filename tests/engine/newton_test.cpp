// Newton's method on cones and bounds: known answers, after few factorisations, and never outside.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/world/world.hpp"
#include "raw_system.hpp"
#include "velocities.hpp"

namespace spook::newton_test {
namespace {

constexpr double h = 1.0 / 60, g = 9.81, mu = 0.5;

Solver<6> on_cones() {
  return newton<6>(FrictionModel::cone);
}

World<6> ground(const Solver<6>& solver, const StopRule& stop = {}, double k = 1e6) {
  World<6> world({.gravity = Vec3(0, 0, -g), .k = k, .friction = mu, .solver = solver, .solver_limits = stop});
  world.add_plane(Vec3::UnitZ(), 0);
  return world;
}

int add_box(World<6>& world, const Vec3& x, double mass, const Vec3& half, const Vec3& v = Vec3::Zero()) {
  return world.add(
      {.x = x, .v = v, .mass = mass, .principal = solid_box_moments(mass, half), .half_sides = half});
}

World<6> tower(const Solver<6>& solver, int boxes, double ratio = 1, const StopRule& stop = {}) {
  World<6> world = ground(solver, stop, 1e6 * ratio);
  for (int n = 0; n < boxes; ++n)
    add_box(world, Vec3(0, 0, n + 0.5), n == boxes - 1 ? ratio : 1, Vec3::Constant(0.5));
  return world;
}

/// A leaning column after a push: some contacts open, some stick, some slide.
World<6> pushed_tower(const Solver<6>& solver, const StopRule& stop, double top = 1) {
  World<6> world = ground(solver, stop);
  for (int n = 0; n < 6; ++n)
    add_box(world, Vec3(0.01 * n, 0, 0.1 + 0.2 * n), n == 5 ? top : 1, Vec3::Constant(0.1),
            Vec3(0.1 * n, 0.05, 0));
  world.step(h);
  return world;
}

void expect_inside(const World<6>& world) {
  for (std::size_t k = 0; k < world.rows().size(); k += 3) {
    const double normal = world.rows()[k].lambda;
    EXPECT_GE(normal, 0);
    const Vec2 along(world.rows()[k + 1].lambda, world.rows()[k + 2].lambda);
    EXPECT_LE(along.norm(), mu * normal * (1 + 1e-15) + 1e-300) << "row " << k;
  }
}

TEST(Newton, SlidesAsCoulombSaysInEveryDirection) {
  // A low block, so that no corner lifts: it loses μ g h of its speed in a step, and nothing across.
  for (int degrees = 0; degrees < 90; degrees += 15) {
    const double angle = degrees * std::numbers::pi / 180;
    const Vec3 way(std::cos(angle), std::sin(angle), 0), half(0.5, 0.5, 0.01);
    World<6> world = ground(on_cones());
    const double sunk = g / (4 * 1e6);
    const int block = add_box(world, Vec3(0, 0, half.z() - sunk), 1, half, 2 * way);
    for (int step = 1; step <= 20; ++step) {
      world.step(h);
      ASSERT_TRUE(world.solved().converged);
      EXPECT_LE(world.report().iterations, 6);
      // Eq. (11.13) allows 1e-13 of |B|, and creep at the viscosity of 1e12 is 1e-11 m/s.
      EXPECT_LE((world.v(block) - (2 - mu * g * h * step) * way).norm(), 1e-10)
          << degrees << "°, step " << step;
    }
  }
}

TEST(Newton, HasTheAnswerOfTheDirectSolverWhereNothingSlides) {
  // Far from all limits friction box and cones are one problem: a tower at rest. Both stop at Eq. (11.13), of which a
  // soft tower of ten makes about a hundred times as much: S has its least pivot at Σ, 1e-3/kg, beside 2/kg.
  for (const double ratio : {1.0, 1e3}) {
    World<6> exact = tower(direct<6>(), 10, ratio), cones = tower(on_cones(), 10, ratio),
             rows = tower(newton<6>(FrictionModel::box), 10, ratio);
    for (int step = 0; step < 30; ++step) {
      for (World<6>* world : {&exact, &cones, &rows}) world->step(h);
      EXPECT_LE(apart(cones, exact), 1e-9 * ratio) << "step " << step << ", " << ratio << ":1";
      EXPECT_LE(apart(rows, exact), 1e-9 * ratio) << "step " << step << ", " << ratio << ":1";
    }
  }
}

TEST(Newton, SolvesATowerInAFewFactorisations) {
  World<6> world = tower(on_cones(), 20);
  int most = 0;
  for (int step = 0; step < 60; ++step) {
    world.step(h);
    EXPECT_TRUE(world.solved().converged);
    most = std::max(most, world.report().iterations);
    EXPECT_LE(world.report().residual, 1e-12);
  }
  EXPECT_LE(most, 8);
  EXPECT_EQ(world.report().iterations, 1) << "an unchanged active set";
}

TEST(Newton, HasTheAnswerOfSweepsWhereSomeContactsSlide) {
  const World<6> slow = pushed_tower(cone_gauss_seidel<6>(), {.max_sweeps = 100'000, .tolerance = 1e-10});
  const World<6> fast = pushed_tower(on_cones(), {});
  ASSERT_TRUE(slow.solved().converged);
  EXPECT_LE(4 * fast.row_updates(), slow.row_updates());
  // A last sweep with a change of 1e-10 m/s may be 1/(1 - ρ) times as far from the solution, for at most ten thousand
  // sweeps. Newton's method may stop at a millionth of |B|, about 2 m/s, if it makes no further progress.
  EXPECT_LE(apart(slow, fast), 1e-5);
}

TEST(Newton, IsInsideTheConesWheneverItStops) {
  for (const double top : {1.0, 1000.0})
    for (int most = 1; most <= 20; ++most) expect_inside(pushed_tower(on_cones(), {.max_sweeps = most}, top));
}

TEST(Newton, IsWithinTheBoundsWheneverItStops) {
  for (const double top : {1.0, 1000.0})
    for (int most = 1; most <= 20; ++most) {
      const World<6> world = pushed_tower(newton<6>(FrictionModel::box), {.max_sweeps = most}, top);
      for (const Row<6>& row : world.rows()) EXPECT_TRUE(row.lo <= row.lambda && row.lambda <= row.hi);
    }
}

TEST(Newton, LeavesNoMoreThanSweepsDo) {
  // Where it does not help, sweeps continue from its result, with their full number.
  for (const double top : {1e-3, 1.0, 10.0, 1e3, 1e5}) {
    const StopRule stop{.max_sweeps = 100};
    const double left = pushed_tower(on_cones(), stop, top).report().residual;
    EXPECT_LE(left, pushed_tower(cone_gauss_seidel<6>(), stop, top).report().residual)
        << "under a top of " << top << " kg";
  }
}

TEST(Newton, GoesOnBySweepsWhereItsFactorisationsAreUsedUp) {
  const World<6> world = pushed_tower(on_cones(), {.max_sweeps = 5}, 1000);
  EXPECT_EQ(world.report().iterations, 5 + 5);
}

TEST(Newton, SweepsWhereNoSigmaSoftensARow) {
  // An infinite viscosity makes Σ of friction 0: there is no K to use.
  World<6> world(
      {.friction = mu, .viscosity = infinity, .solver = on_cones(), .solver_limits = {.max_sweeps = 200}});
  world.add_plane(Vec3::UnitZ(), 0);
  const int block = add_box(world, Vec3(0, 0, 0.1), 1, Vec3(0.5, 0.5, 0.1), Vec3(1, 0, 0));
  world.step(h);
  expect_inside(world);
  EXPECT_NEAR(world.v(block).x(), 1 - mu * 9.81 * h, 1e-3);
}

TEST(Newton, ReturnsAtOnceForRowsAtRest) {
  Motion<3> motion;
  motion.inverse_mass = {{.linear = 0}, {.linear = 1}};
  motion.W = motion.Wf = {Vec3::Zero(), Vec3::Zero()};
  const Constraint<3> rests{.i = 0,
                            .j = 1,
                            .Gi = -Vec3::UnitZ(),
                            .Gj = Vec3::UnitZ(),
                            .gap = 0,
                            .spook = spook_parameters(h, 1e6, 3)};
  for (const int count : {0, 1}) {
    std::vector<Row<3>> rows(static_cast<std::size_t>(count), make_row(rests, motion));
    std::vector<Twist<3>> V(2, Vec3::Zero());
    EXPECT_TRUE(solve_by(newton<3>(FrictionModel::box), motion, rows, V).report.converged) << count;
    EXPECT_EQ(V[1], Vec3::Zero());
  }
}

}  // namespace
}  // namespace spook::newton_test
