// Bodies that touch: rest, piles, and the work that a step without contacts leaves out.
#include <gtest/gtest.h>

#include <cmath>

#include "engine/bodies/conserved_quantities.hpp"
#include "engine/world/world.hpp"

namespace spook::contact_test {
namespace {

constexpr double epsilon = 2.2e-16;
constexpr double g = 9.81;
constexpr double radius = 0.5;

struct Case {
  double h, d;
  int steps;  ///< enough for the decay of the first violation to reach round-off
};

TEST(RestingSphere, GapAndImpulseAreThoseOfTheWeightForAnyStepAndRelaxation) {
  const double m = 3, k = 1e5;
  const Vec3 n = Vec3(0.6, 0, 0.8);  // "down" need not be -z
  for (const Case& c : {Case{1.0 / 60, 3, 2000},
                        {1.0 / 60, 0.5, 2000},
                        {1.0 / 100, 1, 2000},
                        {1.0 / 240, 10, 4000},
                        {1.0 / 30, 2, 2000},
                        {1.0 / 1000, 5, 4000},
                        {1.0 / 60, 50, 20000}}) {
    World<6> world({.gravity = -g * n, .k = k, .d = c.d});
    world.add_plane(n, 0);
    const int sphere =
        world.add({.x = radius * n, .mass = m, .radius = radius, .principal = solid_sphere_moments(m, radius)});
    for (int step = 0; step < c.steps; ++step) world.step(c.h);

    const SpookParameters s = spook_parameters(c.h, k, c.d);
    const double gap_rounding = 4 * epsilon * radius;
    const std::string which = "h " + std::to_string(c.h) + ", d " + std::to_string(c.d);
    ASSERT_EQ(world.contacts().size(), 1U) << which;
    // A stiff contact moves x by less than round-off before its decay is over.
    const double last_move = gap_rounding * (1 + 4 * c.d);
    EXPECT_NEAR(n.dot(world.x(sphere)) - radius, -m * g / k, last_move) << which;
    EXPECT_NEAR(world.lambda(0), c.h * m * g, s.a * last_move / (1 / m + s.Sigma) + 8 * epsilon * c.h * m * g)
        << which;
    EXPECT_NEAR(world.v(sphere).norm(), 0, last_move / c.h) << which;
    EXPECT_LE(world.report().residual, 1e-12) << which;
  }
}

TEST(RestingSphere, ContactPushesAndNeverPulls) {
  World<3> world({.k = 1e4, .d = 0.5, .contact_margin = 0.0});
  world.add_plane(Vec3::UnitZ(), 0);
  const int sphere = world.add({.x = Vec3(0, 0, 0.6), .v = Vec3(0, 0, -3), .radius = radius});
  bool touched = false, let_go = false;
  for (int step = 0; step < 600; ++step) {
    const double gap = world.x(sphere).z() - radius;
    world.step(1.0 / 60);
    ASSERT_EQ(world.contacts().size(), gap <= 0 ? 1U : 0U) << "step " << step;
    if (gap <= 0) {
      ASSERT_GE(world.lambda(0), 0);
      touched = true;
    } else if (touched) {
      let_go = true;
    }
  }
  EXPECT_TRUE(touched);
  EXPECT_TRUE(let_go) << "the sphere should bounce";
}

template <int Dof>
World<Dof> pile(int count, double heavy, bool heavy_on_top, const StopRule& stop) {
  World<Dof> world({.k = 1e6, .d = 3, .solver = gauss_seidel<Dof>(), .solver_limits = stop});
  world.add_plane(Vec3::UnitZ(), 0);
  for (int i = 0; i < count; ++i) {
    Body<Dof> body;
    body.x = Vec3(0, 0, (2 * i + 1) * radius);
    body.mass = i == (heavy_on_top ? count - 1 : 0) ? heavy : 1;
    body.radius = radius;
    world.add(body);
  }
  return world;
}

TEST(Stack, EveryContactCarriesTheWeightAboveIt) {
  for (const double ratio : {1.0, 1000.0})
    for (const bool heavy_on_top : {true, false}) {
      const int count = 4;
      const double h = 1.0 / 60;
      World<3> world = pile<3>(count, ratio, heavy_on_top, {.max_sweeps = 100'000, .tolerance = 1e-12});
      for (int step = 0; step < 200; ++step) world.step(h);
      ASSERT_EQ(world.contacts().size(), static_cast<std::size_t>(count));
      double load = 0;
      for (int c = count - 1; c >= 0; --c) {
        load += world.bodies().mass[static_cast<std::size_t>(c + 1)] * g;
        // The residual of Gauss-Seidel, 1e-12 m/s over a rate of 1 - ρ >= 1e-4, is far smaller.
        EXPECT_NEAR(world.contacts()[static_cast<std::size_t>(c)].gap, -load / 1e6, 1e-5 * load / 1e6)
            << "ratio " << ratio << ", heavy on top " << heavy_on_top << ", contact " << c;
        EXPECT_NEAR(world.lambda(c), h * load, 1e-5 * h * load);
      }
    }
}

TEST(Stack, SweepsGoWithTheTheoryOfTwoBodies) {
  // ρ = 1/((1 + mΣ)(1 + m/M + mΣ)) a sweep. From one tolerance to the next, ln(100)/ln(1/ρ) sweeps.
  const double h = 1.0 / 60, M = 1000;
  const double Sigma = spook_parameters(h, 1e6, 3).Sigma;
  const double rate = 1 / ((1 + Sigma) * (1 + 1 / M + Sigma));
  const auto sweeps = [&](double tolerance, bool heavy_on_top) {
    World<3> world = pile<3>(2, M, heavy_on_top, {.max_sweeps = 100'000, .tolerance = tolerance});
    world.step(h);
    return world.report().iterations;
  };
  EXPECT_NEAR(sweeps(1e-8, true) - sweeps(1e-6, true), std::log(100) / -std::log(rate), 2);
  EXPECT_LE(sweeps(1e-8, false), 10);
}

TEST(Stack, MoreSweepsComeCloser) {
  const auto error = [](int sweeps) {
    World<3> world = pile<3>(6, 1, true, {.max_sweeps = sweeps});
    for (int step = 0; step < 300; ++step) world.step(1.0 / 60);
    return std::abs(world.x(1).z() - radius + 6 * g / 1e6) / (6 * g / 1e6);
  };
  double before = error(25);
  for (const int sweeps : {50, 100, 200, 400}) {
    const double now = error(sweeps);
    EXPECT_LT(now, before) << sweeps << " sweeps";
    before = now;
  }
  EXPECT_LT(before, 1e-6);
}

TEST(Stack, PointMassesAndRigidBodiesAgree) {
  World<3> points = pile<3>(5, 10, true, {});
  World<6> bodies = pile<6>(5, 10, true, {});
  for (int step = 0; step < 300; ++step) {
    points.step(1.0 / 60);
    bodies.step(1.0 / 60);
    for (int i = 1; i <= 5; ++i)
      // The same operations, except for products with zero and the order of a sum.
      ASSERT_NEAR((points.x(i) - bodies.x(i)).norm(), 0, 1e-12) << "step " << step << ", body " << i;
  }
  for (int i = 1; i <= 5; ++i)
    EXPECT_EQ(angular_velocity(bodies, i), Vec3::Zero().eval()) << "no torque acts in a frictionless pile";
}

TEST(Spheres, CollisionKeepsMomentumAndAngularMomentum) {
  World<6> world({.gravity = Vec3::Zero(), .k = 1e4, .d = 1});
  world.add({.x = Vec3(-1, 0.2, 0), .v = Vec3(3, 0, 0.5), .mass = 2, .radius = radius});
  world.add({.x = Vec3(1, -0.2, 0.1), .v = Vec3(-1, 0, 0), .mass = 0.5, .radius = radius});
  const Vec3 p = momentum(world.bodies()), L = angular_momentum(world.bodies());
  const Vec3 v = world.v(0);
  for (int step = 0; step < 200; ++step) world.step(0.01);
  EXPECT_GT((world.v(0) - v).norm(), 0.1) << "they should meet";
  EXPECT_LE((momentum(world.bodies()) - p).norm(), 200 * epsilon * 7);
  // The impulse acts along the line of centres at x_n, the same line for both: L is conserved, too.
  EXPECT_LE((angular_momentum(world.bodies()) - L).norm(), 200 * epsilon * 50);
}

TEST(Spheres, RestOnAFixedOneAndFixedOnesDoNotTouch) {
  World<3> world({.k = 1e6});
  world.add_fixed(Vec3(0, 0, 0), 1);
  world.add_fixed(Vec3(0.5, 0, -0.5), 1);
  const int body = world.add({.x = Vec3(0, 0, 1.5), .radius = radius});
  for (int step = 0; step < 300; ++step) world.step(1.0 / 60);
  ASSERT_EQ(world.contacts().size(), 1U);
  EXPECT_EQ(world.contacts()[0].i, 0);
  EXPECT_EQ(world.contacts()[0].j, body);
  EXPECT_NEAR(world.x(body).z() - 1.5, -g / 1e6, 1e-14);
}

TEST(Spheres, AtOnePlaceArePartedWithoutANaN) {
  World<3> world({.gravity = Vec3::Zero()});
  world.add({.radius = radius});
  world.add({.radius = radius});
  for (int step = 0; step < 60; ++step) world.step(1.0 / 60);
  EXPECT_GE((world.x(0) - world.x(1)).norm(), 0.9);
}

int solver_calls = 0;

TEST(Step, DoesNothingForWhatASceneDoesNotHave) {
  const Solver<3> counting{.solve = [](const SolverInput<3>& system) {
    ++solver_calls;
    return gauss_seidel<3>().solve(system);
  }};
  solver_calls = 0;

  World<3> plain({.solver = counting});
  plain.add({});
  plain.step(0.01);
  EXPECT_EQ(plain.report().pairs, 0) << "without shapes no pair is tested";

  World<3> apart({.solver = counting});
  apart.add_plane(Vec3::UnitZ(), 0);
  apart.add({.x = Vec3(0, 0, 5), .radius = radius});
  apart.step(0.01);
  EXPECT_EQ(apart.report().pairs, 1);
  EXPECT_EQ(apart.report().contacts, 0);
  EXPECT_EQ(apart.report().rows, 0);
  EXPECT_EQ(apart.report().iterations, 0);
  EXPECT_EQ(apart.report().residual, 0);
  EXPECT_EQ(solver_calls, 0) << "no rows: no solve";
}

TEST(Step, ForgetsContactsThatAreOver) {
  World<3> world({.gravity = Vec3::Zero()});
  world.add_plane(Vec3::UnitZ(), 0);
  world.add({.x = Vec3(0, 0, radius), .v = Vec3(0, 0, 1), .radius = radius});
  world.step(0.1);
  EXPECT_EQ(world.report().rows, 1);
  world.step(0.1);
  EXPECT_EQ(world.report().rows, 0);
  EXPECT_EQ(world.report().iterations, 0);
  EXPECT_TRUE(world.contacts().empty());
}

}  // namespace
}  // namespace spook::contact_test
