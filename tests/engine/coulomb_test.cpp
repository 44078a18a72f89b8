// Default friction: Coulomb's law, limited by the normal impulse, at every step size that a newcomer types.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "engine/bodies/conserved_quantities.hpp"
#include "engine/diagnostics/run_check.hpp"
#include "engine/world/world.hpp"

namespace spook::coulomb_test {
namespace {

constexpr double g = 9.81;

/// Step sizes that users type [s].
const std::vector<double> all_steps = {1.0 / 30, 1.0 / 60, 1.0 / 240, 1.0 / 1000};

int add_box(World<6>& world, const Vec3& x, const Vec3& half, double mass, const Vec3& v = Vec3::Zero(),
            const Quat& q = Quat::Identity()) {
  return world.add(
      {.x = x, .v = v, .mass = mass, .q = q, .principal = solid_box_moments(mass, half), .half_sides = half});
}

/// Runs for a time, and expects it to be sound.
void run(World<6>& world, double h, double time) {
  RunCheck<6> check;
  for (int n = 0; n < std::lround(time / h); ++n) {
    world.step(h);
    check.look(world, h);
  }
  EXPECT_EQ(name_of(check.verdict().state), "sound") << check.verdict().reason << ", h " << h;
}

/// A body that slides to a stop from v0 goes v0²/(2 μ g), less leapfrog's error: half a step of its first and last
/// speed.
void expect_way(double way, double v0, double mu, double h) {
  const double coulomb = v0 * v0 / (2 * mu * g);
  EXPECT_NEAR(way, coulomb - v0 * h / 2, mu * g * h * h + 0.003 * coulomb) << "h " << h;
}

TEST(Coulomb, ASledgeCarriesItsLoadsFriction) {
  // 1 kg under 20 kg: a bound of the sledge's own weight would let it slide nine times as far.
  for (const double h : all_steps) {
    World<6> world({.friction = 0.5});
    world.add_plane(Vec3::UnitZ(), 0);
    const int sledge = add_box(world, Vec3(0, 0, 0.1), Vec3(0.5, 0.3, 0.1), 1, Vec3(3, 0, 0)),
              load = add_box(world, Vec3(0, 0, 0.3), Vec3(0.3, 0.3, 0.1), 20, Vec3(3, 0, 0));
    run(world, h, 2);
    for (const int body : {sledge, load}) expect_way(world.x(body).x(), 3, 0.5, h);
  }
}

TEST(Coulomb, SlidesAsFarInEveryDirection) {
  for (const double h : all_steps)
    for (const double degrees : {0.0, 22.5, 45.0, 70.0}) {
      const double angle = degrees * std::numbers::pi / 180;
      const Vec3 ahead(std::cos(angle), std::sin(angle), 0), aside(-std::sin(angle), std::cos(angle), 0);
      World<6> world({.friction = 0.5});
      world.add_plane(Vec3::UnitZ(), 0);
      const int block = add_box(world, Vec3(0, 0, 0.1), Vec3(0.2, 0.2, 0.1), 1, 3 * ahead);
      run(world, h, 1);
      expect_way(world.x(block).dot(ahead), 3, 0.5, h);
      EXPECT_LE(std::abs(world.x(block).dot(aside)), 1e-6) << degrees << "°, h " << h;
    }
}

TEST(Coulomb, WhatAForcePressesSticksWithoutGravityToo) {
  // 50 N press, 15 N pull, and μ is 0.6, which holds up to 30 N. A tenth of the normal force holds 3 N.
  for (const double gravity : {0.0, 9.81})
    for (const double h : all_steps)
      for (const double press : {50.0, 5.0}) {
        const auto wrench = [press](std::size_t, const Bodies<6>&, double) {
          Twist<6> of = Twist<6>::Zero();
          of.head<3>() = Vec3(15, 0, -press);
          return of;
        };
        World<6> world({.gravity = Vec3(0, 0, -gravity), .wrench = wrench, .friction = 0.6});
        world.add_plane(Vec3::UnitZ(), 0);
        const int cube = add_box(world, Vec3(0, 0, 0.1), Vec3::Constant(0.1), 1);
        run(world, h, 1);
        const double pull = 15 - 0.6 * (press + gravity);
        const double wanted = pull > 0 ? pull / 2 : 0;
        // Leapfrog from rest is half a step of the speed ahead, h a t/2; a fall in the first step adds to it. A
        // sticking box leans by 15 N 0.1 m over k r² of four corners, 3.75e-5 rad.
        EXPECT_NEAR(world.x(cube).x(), wanted, 1.2 * h * std::max(pull, 0.0) + 4e-6) << press << " N, h " << h;
      }
}

TEST(Coulomb, OnTwoBoxesAsOnOne) {
  // A slope of 0.4 rad with μ = 0.3: g (sin θ - μ cos θ) t²/2 in two seconds, for a slope of any kind.
  const double angle = 0.4, mu = 0.3;
  for (const double h : all_steps) {
    World<6> world({.gravity = g * Vec3(std::sin(angle), 0, -std::cos(angle)), .friction = mu});
    for (const double side : {-1.0, 1.0}) world.add_fixed_box(Vec3(0, side, -0.5), Vec3(20, 0.99, 0.5));
    const int cube = add_box(world, Vec3(0, 0, 0.2), Vec3::Constant(0.2), 1);
    world.start_half_step_back(h);
    run(world, h, 2);
    const double a = g * (std::sin(angle) - mu * std::cos(angle));
    EXPECT_NEAR(world.x(cube).x(), 2 * a, 0.01 * 2 * a + 2 * h * a) << "h " << h;
  }
}

TEST(Coulomb, APlankStaysOnTheBoxThatItIsPartlyOn) {
  for (const double h : all_steps) {
    World<6> world({.friction = 0.5});
    world.add_plane(Vec3::UnitZ(), 0);
    add_box(world, Vec3(-1, 0, 0.2), Vec3::Constant(0.2), 1);
    add_box(world, Vec3(1, 0, 0.2), Vec3::Constant(0.2), 1);
    const int plank = add_box(world, Vec3(0, 0, 0.45), Vec3(1.2, 0.1, 0.05), 1),
              load = add_box(world, Vec3(0, 0, 0.6), Vec3::Constant(0.1), 30);
    run(world, h, 3);
    EXPECT_NEAR(world.x(plank).z(), 0.45, 1e-3) << "h " << h;
    EXPECT_LE((world.x(load) - Vec3(0, 0, 0.6)).norm(), 1e-3) << "h " << h;
  }
}

TEST(Coulomb, SurvivesMassesWhoseFactorsFail) {
  // The factors of these masses overflow, in every method.
  World<6> world({.friction = 0.5});
  world.add_plane(Vec3::UnitZ(), 0);
  world.add({.x = Vec3(0, 0, 0.099), .mass = 1e-160, .half_sides = Vec3(0.1, 0.1, 0.1)});
  const int box = world.add({.x = Vec3(0.02, 0, 0.298), .mass = 1, .half_sides = Vec3(0.1, 0.1, 0.1)});
  for (int n = 0; n < 20; ++n) world.step(1.0 / 60);
  EXPECT_TRUE(world.x(box).allFinite());
}

TEST(Coulomb, ARestingPileNeedsFewSweeps) {
  // A pyramid of 55 cubes: after two seconds a step takes a few sweeps on average, not twenty factorisations. It
  // stops when a sweep changes no row by more than 1e-6 of the right-hand side; the residual may then be a little larger.
  World<6> world({.friction = 0.6});
  world.add_plane(Vec3::UnitZ(), 0);
  for (int row = 0; row < 10; ++row)
    for (int column = 0; column < 10 - row; ++column)
      add_box(world, Vec3(column + 0.5 * row, 0, row + 0.5), Vec3::Constant(0.5), 100);
  const double h = 1.0 / 60;
  for (int n = 0; n < 120; ++n) world.step(h);
  int iterations = 0;
  const std::int64_t before = world.row_updates();
  for (int n = 0; n < 60; ++n) {
    world.step(h);
    iterations += world.report().iterations;
    double largest = 0;
    for (const Row<6>& row : world.rows()) largest = std::max(largest, std::abs(row.B));
    EXPECT_LE(world.report().residual, 2e-6 * largest);
  }
  EXPECT_LE(iterations, 15 * 60);
  EXPECT_LE(world.row_updates() - before, 15 * 60 * std::ssize(world.rows()));
  EXPECT_LE(kinetic_energy(world.bodies()), 1e-9);
}

// Contacts in motion are others in the next step, so sweeps may end early; where they are slow, factors follow.
TEST(Coulomb, AFallingHeapIsSolvedToAShareOfItsApproach) {
  const double h = 0.01;
  for (int number = 0; number < 7; ++number) {
    World<6> world({.friction = 0.5});
    world.add_plane(Vec3::UnitZ(), 0);
    for (const Vec3& inwards : {Vec3(1, 0, 0), Vec3(-1, 0, 0), Vec3(0, 1, 0), Vec3(0, -1, 0)})
      world.add_plane(inwards, -0.5);
    for (int n = 0; n < 64; ++n) {
      const Vec3 cell(n % 4 - 1.5, n / 4 % 4 - 1.5, n / 16 + 0.5);
      const Vec3 turned = Vec3(1, 2, 3) * ((n + number) % 7 - 3.0) / 10;
      add_box(world, 0.24 * cell, Vec3::Constant(0.06), 1, Vec3::Zero(),
              Quat(1, turned.x(), turned.y(), turned.z()).normalized());
    }
    RunCheck<6> check;
    for (int n = 0; n < 100; ++n) {
      world.step(h);
      check.look(world, h);
      double approach = 0;
      for (std::size_t k = 0; k < world.rows().size(); k += 3)
        approach = std::max(approach, std::abs(world.rows()[k].B));
      EXPECT_LE(world.report().residual, 3e-3 * approach) << "heap " << number << ", step " << n;
    }
    EXPECT_EQ(name_of(check.verdict().state), "sound") << check.verdict().reason;
  }
}

}  // namespace
}  // namespace spook::coulomb_test
