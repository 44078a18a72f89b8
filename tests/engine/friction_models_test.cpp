// Friction limited by the normal impulse: chapter 09 in the engine, against the box and against Coulomb's law. The box
// takes its bound from a mass, not from the load, Eq. (5.15), and its error has an exact size.
#include <gtest/gtest.h>

#include <cmath>

#include "engine/bodies/conserved_quantities.hpp"
#include "scene_runs.hpp"

namespace spook::friction_models_test {
namespace {

constexpr double g = 9.81, radius = 0.5, k = 1e6, h = 1.0 / 60;

/// A friction model.
struct Way {
  std::string name;
  FrictionModel model;
  bool sliding = false;
  std::string solver_name = "gauss_seidel";

  Solver<3> solver() const { return make_solver<3>({.h = h, .solver = solver_name, .friction_model = model}); }
};
const std::vector<Way> better = {{"two passes", FrictionModel::two_pass},
                                 {"two passes along the slip", FrictionModel::two_pass, true},
                                 {"cone", FrictionModel::cone},
                                 {"cone along the slip", FrictionModel::cone, true}};

/// Speed of the fastest of n spheres, stacked as points on a slope, after a second from rest.
double speed_of_pile_on_slope(int n, double mu, double angle, const Way& way) {
  World<3> world({.gravity = g * Vec3(std::sin(angle), 0, -std::cos(angle)),
                  .k = k,
                  .friction = mu,
                  .viscosity = infinity,
                  .sliding_tangents = way.sliding,
                  .solver = way.solver(),
                  .solver_limits = {.max_sweeps = 20'000, .tolerance = 1e-14}});
  world.add_plane(Vec3::UnitZ(), 0);
  double z = radius;
  for (int i = 0; i < n; ++i) {
    z -= (n - i) * g * std::cos(angle) / k;  // at rest from the start: gap = -N/k, Eq. (3.13)
    world.add({.x = Vec3(0, 0, z), .radius = radius});
    z += 2 * radius;
  }
  for (int step = 0; step < 60; ++step) world.step(h);
  double fastest = 0;
  for (int i = 1; i <= n; ++i) fastest = std::max(fastest, world.v(i).norm());
  return fastest;
}

void expect_pile_needs(double mu, int n, double angle, const Way& way) {
  // In a second, a bound that is a thousandth too small in each step moves a sphere at some hundredths of g sin θ · 1 s
  // or more.
  EXPECT_GT(speed_of_pile_on_slope(n, 0.99 * mu, angle, way), 0.005 * g * std::sin(angle))
      << n << " spheres, " << way.name;
  EXPECT_LT(speed_of_pile_on_slope(n, 1.01 * mu, angle, way), 1e-10) << n << " spheres, " << way.name;
}

TEST(BetterFriction, APileOnASlopeNeedsNoMoreThanABody) {
  const double angle = 0.2;
  for (const Way& way : better)
    for (const int n : {1, 2, 3}) expect_pile_needs(std::tan(angle), n, angle, way);
}

TEST(FrictionBox, APileOnASlopeNeedsMoreFrictionThanABody) {
  // The ground needs the bound for n weights and has it for one. Contact i above it needs n - i and has half a bound.
  const double angle = 0.2;
  const auto needed = [&](int n) {
    double factor = n;
    for (int i = 1; i < n; ++i) factor = std::max(factor, 2.0 * (n - i));
    return factor * std::tan(angle);
  };
  EXPECT_DOUBLE_EQ(needed(1), std::tan(angle));
  EXPECT_DOUBLE_EQ(needed(2), 2 * std::tan(angle));
  EXPECT_DOUBLE_EQ(needed(3), 4 * std::tan(angle)) << "between the first and the second";
  for (const int n : {1, 2, 3})
    expect_pile_needs(needed(n), n, angle, {"box", FrictionModel::box, false, "auto"});
}

/// The stopping position of a block, as a point, that slides at 1 m/s at so many radians from the x axis [m].
Vec3 stop_of_block(double heading, const Way& way) {
  const double mu = 0.3;
  const Vec3 along(std::cos(heading), std::sin(heading), 0);
  World<3> world({.k = k, .friction = mu, .sliding_tangents = way.sliding, .solver = way.solver()});
  world.add_plane(Vec3::UnitZ(), 0);
  const double step = 1e-3;
  const int block =
      world.add({.x = Vec3(0, 0, radius - g / k), .v = (1 + mu * g * step / 2) * along, .radius = radius});
  for (int n = 0; n < 500; ++n) world.step(step);
  return world.x(block) - Vec3(0, 0, radius - g / k);
}

TEST(BetterFriction, ABlockStopsAsCoulombSaysInEveryDirection) {
  // v²/(2 μ g), to the order of the last step: v h with v = μ g h.
  const double way_to_stop = 1 / (2 * 0.3 * g), tolerance = 0.3 * g * 1e-6;
  for (double heading = 0.1; heading < 6.3; heading += 0.5) {
    const Vec3 expected = way_to_stop * Vec3(std::cos(heading), std::sin(heading), 0);
    for (const Way& way :
         {Way{"box along the slip", FrictionModel::box, true}, better[1], better[2], better[3]})
      EXPECT_LE((stop_of_block(heading, way) - expected).norm(), tolerance)
          << way.name << ", heading " << heading;
    EXPECT_GT((stop_of_block(heading, {"box", FrictionModel::box}) - expected).norm(), 100 * tolerance);
  }
}

TEST(BetterFriction, ADiscStopsAtCoulombsTime) {
  // Under an even pressure ω falls linearly to 0 at 3Rω0/(4μg); the box stops it at π/4 of that.
  const SceneSettings coulomb = {{"answer", "coulomb"}};
  const SceneDescription& disc = find_scene("spinning_disc");
  const auto error = [&](FrictionModel model, bool sliding, const std::string& solver) {
    const auto scene =
        disc.build(with(disc, coulomb), {.h = 0.01,
                                         .solver = solver,
                                         .solver_limits = {.max_sweeps = 5000, .tolerance = 1e-12},
                                         .friction_model = model,
                                         .sliding_tangents = sliding});
    for (int n = 0; n < 100; ++n) {
      scene->observe();
      scene->advance(1);
    }
    return scene->error();
  };
  EXPECT_GT(error(FrictionModel::box, false, "direct"), 0.2);
  EXPECT_LT(error(FrictionModel::box, true, "direct"), 1e-9);
  EXPECT_LT(error(FrictionModel::two_pass, true, "direct"), 1e-9);
  EXPECT_LT(error(FrictionModel::cone, false, "gauss_seidel"), 1e-9);
}

TEST(BetterFriction, KeepsTheMomentaOfFreeBodies) {
  // Two balls overlap and slide on each other in free space. Their contact point is one, Eq. (8.3): L is conserved.
  for (const Way& way : better) {
    World<6> world({.gravity = Vec3::Zero(),
                    .k = 1e3,
                    .friction = 0.5,
                    .sliding_tangents = way.sliding,
                    .solver = make_solver<6>({.h = h, .friction_model = way.model})});
    const Vec3 moments = solid_sphere_moments(1, radius);
    world.add({.x = Vec3(0, 0, 0), .radius = radius, .omega = Vec3(0, 3, 1), .principal = moments});
    world.add({.x = Vec3(0.9, 0.1, 0), .v = Vec3(-1, 0.5, 0.2), .radius = radius, .principal = moments});
    const Vec3 p = momentum(world.bodies()), L = angular_momentum(world.bodies());
    for (int step = 0; step < 60; ++step) world.step(h);
    EXPECT_GT((world.v(0)).norm(), 0.1) << "they should meet";
    EXPECT_LE((momentum(world.bodies()) - p).norm(), 1e-13) << way.name;
    // The impulse acts at the contact, at x_n. L is computed at x_n, too, so there is no error of order h.
    EXPECT_LE((angular_momentum(world.bodies()) - L).norm(), 1e-13) << way.name;
  }
}

TEST(BetterFriction, TheConeReportsItsOwnResidual) {
  World<3> world({.k = k,
                  .friction = 0.5,
                  .solver = cone_gauss_seidel<3>(),
                  .solver_limits = {.max_sweeps = 1000, .tolerance = 1e-14}});
  world.add_plane(Vec3::UnitZ(), 0);
  world.add({.x = Vec3(0, 0, radius), .v = Vec3(1, 0, 0), .radius = radius});
  world.step(h);
  EXPECT_LE(world.report().residual, 1e-13);
  const Vec3 impulse = world.impulse(0);
  EXPECT_NEAR(impulse.head<2>().norm(), 0.5 * impulse.z(), 1e-14) << "it slides: on the cone";
}

}  // namespace
}  // namespace spook::friction_models_test
