// Friction and impacts in the engine: the work done, the work left out, and conserved quantities.
#include <gtest/gtest.h>

#include <cmath>

#include "engine/bodies/conserved_quantities.hpp"
#include "engine/world/world.hpp"
#include "random_input.hpp"
#include "scenes/disc.hpp"

namespace spook::friction_test {
namespace {

constexpr double epsilon = 2.2e-16;
constexpr double g = 9.81, radius = 0.5;

bool ran(const StageTimes& times, Stage stage) {
  const auto s = static_cast<std::size_t>(stage);
  EXPECT_EQ(times.seconds[s] > 0, times.runs[s] > 0) << stage_names[s];
  return times.runs[s] > 0;
}

template <int Dof>
void add_sphere(World<Dof>& world, double z) {
  Body<Dof> body;
  body.x = Vec3(0, 0, z);
  body.radius = radius;
  world.add(body);
}

TEST(Rows, AreOneOfASmoothContactAndThreeOfARoughOne) {
  for (const double mu : {0.0, 0.3}) {
    World<3> points({.friction = mu});
    World<6> bodies({.friction = mu});
    points.add_plane(Vec3::UnitZ(), 0);
    bodies.add_plane(Vec3::UnitZ(), 0);
    for (const double x : {0.0, 5.0}) {
      points.add({.x = Vec3(x, 0, radius), .radius = radius});
      bodies.add({.x = Vec3(x, 0, radius), .radius = radius});
    }
    bodies.add(
        {.x = Vec3(10, 0, radius), .principal = Vec3::Ones(), .corners = box_corners(Vec3::Constant(radius))});
    points.step(0.01);
    bodies.step(0.01);
    EXPECT_EQ(points.report().rows, mu > 0 ? 6 : 2);
    EXPECT_EQ(bodies.report().contacts, 2 + 4);
    EXPECT_EQ(bodies.report().rows, mu > 0 ? 18 : 6);
  }
}

TEST(StageTimes, AreOfStagesThatRanOnly) {
  const auto times_of = [](World<3>& world) {
    world.time_stages();
    for (int n = 0; n < 3; ++n) world.step(0.01);
    return world.stage_times();
  };
  World<3> alone({.friction = 0.5, .impacts = ImpactLaw{}});
  add_sphere(alone, 3);
  const StageTimes nothing_to_touch = times_of(alone);
  for (const Stage stage : {Stage::contacts, Stage::impacts, Stage::rows, Stage::solve})
    EXPECT_FALSE(ran(nothing_to_touch, stage));
  for (const Stage stage : {Stage::forces, Stage::integrate}) EXPECT_TRUE(ran(nothing_to_touch, stage));

  World<3> smooth({});
  smooth.add_plane(Vec3::UnitZ(), 0);
  add_sphere(smooth, radius);
  const StageTimes without_impacts = times_of(smooth);
  EXPECT_FALSE(ran(without_impacts, Stage::impacts));
  for (const Stage stage : {Stage::contacts, Stage::forces, Stage::rows, Stage::solve, Stage::integrate})
    EXPECT_TRUE(ran(without_impacts, stage));

  World<3> untimed({});
  add_sphere(untimed, 3);
  untimed.step(0.01);
  for (const std::int64_t runs : untimed.stage_times().runs) EXPECT_EQ(runs, 0) << "it is off by default";
}

TEST(Impacts, DoNothingWhereNothingTouches) {
  World<3> world({.friction = 0.5, .impacts = ImpactLaw{.restitution = 1}}), plain({});
  for (World<3>* each : {&world, &plain}) {
    each->add_plane(Vec3::UnitZ(), 0);
    add_sphere(*each, 30);
    each->time_stages();
    for (int n = 0; n < 20; ++n) each->step(0.01);
  }
  EXPECT_EQ(world.report().impacts, 0);
  EXPECT_EQ(world.report().rows, 0);
  EXPECT_EQ(world.x(1), plain.x(1));
  EXPECT_FALSE(ran(world.stage_times(), Stage::solve));
}

TEST(Impacts, AreCountedInTheStepOfTheImpactOnly) {
  World<3> world({.gravity = Vec3::Zero(), .impacts = ImpactLaw{.restitution = 1}});
  world.add_plane(Vec3::UnitZ(), 0);
  world.add({.x = Vec3(0, 0, radius + 1), .v = Vec3(0, 0, -4), .radius = radius});
  int impacts = 0;
  for (int n = 1; n <= 10; ++n) {
    world.step(0.125);
    impacts += world.report().impacts;
    EXPECT_EQ(world.report().impacts, n == 3 ? 1 : 0) << "step " << n;  // it is there after two steps
  }
  EXPECT_EQ(impacts, 1);
  EXPECT_EQ(world.v(1), Vec3(0, 0, 4));
}

TEST(Impacts, KeepMomentumAndAngularMomentum) {
  testing::Random random;
  for (int trial = 0; trial < 50; ++trial) {
    const double mu = trial % 2 == 0 ? 0 : random.uniform(0, 2);
    World<6> world(
        {.gravity = Vec3::Zero(), .impacts = ImpactLaw{.restitution = random.uniform(0, 1), .friction = mu}});
    // They come from 2 m on either side, and meet off-centre, by 0.5 m and at most 0.4 m more.
    for (const double side : {-1.0, 1.0}) {
      const double m = random.log_uniform(0.1, 10);
      world.add({.x = side * Vec3(2, 0.2, 0.15),
                 .v = Vec3(-3 * side, 0, 0) + random.vector(0.2),
                 .mass = m,
                 .radius = radius,
                 .omega = random.vector(5),
                 .principal = solid_sphere_moments(m, radius)});
    }
    const Vec3 p = momentum(world.bodies()), L = angular_momentum(world.bodies());
    int impacts = 0;
    for (int n = 0; n < 100; ++n) {
      world.step(0.01);
      impacts += world.report().impacts;
    }
    ASSERT_EQ(impacts, 1);
    const double roundings = 100 * epsilon * 1000;
    EXPECT_LE((momentum(world.bodies()) - p).norm(), roundings);
    EXPECT_LE((angular_momentum(world.bodies()) - L).norm(), roundings) << "mu " << mu;
  }
}

/// A rigid sphere on a plane, at its depth at rest.
World<6> rough_sphere(double mu, const Vec3& v, const Vec3& omega) {
  World<6> world({.friction = mu});
  world.add_plane(Vec3::UnitZ(), 0);
  world.add({.x = Vec3(0, 0, radius - g / 1e6),
             .v = v,
             .radius = radius,
             .omega = omega,
             .principal = solid_sphere_moments(1, radius)});
  return world;
}

TEST(Friction, NeverAddsEnergy) {
  testing::Random random;
  for (int trial = 0; trial < 40; ++trial) {
    Vec3 v = random.vector(3);
    v.z() = 0;
    const double mu = random.uniform(0, 2);
    World<6> sphere = rough_sphere(mu, v, random.vector(10));
    double energy = kinetic_energy(sphere.bodies());
    for (int n = 0; n < 100; ++n) {
      sphere.step(0.01);
      const double now = kinetic_energy(sphere.bodies());
      // A sphere's friction does not change its normal force: only friction acts, and round-off.
      ASSERT_LE(now, energy * (1 + 20 * epsilon)) << "trial " << trial << ", step " << n;
      energy = now;
    }
    ASSERT_EQ(sphere.report().contacts, 1);
  }
}

TEST(Friction, OfADiscNeverAddsEnergy) {
  testing::Random random;
  for (int trial = 0; trial < 5; ++trial) {
    World<6> disc({.k = 1e3,
                   .friction = random.uniform(0.5, 1),
                   .solver_limits = {.max_sweeps = 300, .tolerance = 1e-14}});
    disc.add_plane(Vec3::UnitZ(), 0);
    disc.add({.x = Vec3(0, 0, -g / (1e3 * 16)),
              .v = Vec3{random.uniform(-2, 2), random.uniform(-2, 2), 0},
              .omega = Vec3(0, 0, random.uniform(-10, 10)),
              .principal = Vec3(0.0625, 0.0625, 0.125),
              .corners = disc_points(radius, 2, 8)});
    double energy = kinetic_energy(disc.bodies());
    for (int n = 0; n < 100; ++n) {
      disc.step(0.01);
      const double now = kinetic_energy(disc.bodies());
      // The sweeps end at 1e-14 m/s in each of 48 rows, at speeds of up to some 10 m/s.
      ASSERT_LE(now, energy + 1e-11) << "trial " << trial << ", step " << n;
      energy = now;
    }
    EXPECT_LE(energy, 1e-12) << "it should stop";
  }
}

TEST(Friction, IsBoundedByTheMassAndGravityAlongTheNormal) {
  // On a slope of 60°, with μ = 1: (5.7) has cos 60°.
  const double h = 0.01, mu = 1, m = 2;
  const Vec3 n(std::sqrt(0.75), 0, 0.5);
  World<3> world({.friction = mu, .solver = gauss_seidel<3>()});
  world.add_plane(n, 0);
  world.add({.x = radius * n, .v = Vec3(0, 3, 0), .mass = m, .radius = radius});
  world.step(h);
  ASSERT_EQ(world.contacts().size(), 1U);
  const Vec3 J = world.impulse(0);
  const Vec3 rub = J - J.dot(n) * n;
  EXPECT_NEAR(rub.cwiseAbs().maxCoeff(), mu * m * g * 0.5 * h, 1e-12);
  EXPECT_NEAR(J.dot(n), world.lambda(0), 1e-15);
}

}  // namespace
}  // namespace spook::friction_test
