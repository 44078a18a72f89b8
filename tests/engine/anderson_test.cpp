// Anderson acceleration: the solution of sweeps, after fewer sweeps, and always within the bounds.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "engine/world/world.hpp"
#include "velocities.hpp"

namespace spook::anderson_test {
namespace {

constexpr double mu = 0.5;

/// A leaning column of boxes after one step with a push.
World<6> pushed_tower(const Solver<6>& solver, const StopRule& stop, double top = 1) {
  World<6> world({.k = 1e6, .friction = mu, .solver = solver, .solver_limits = stop});
  world.add_plane(Vec3::UnitZ(), 0);
  for (int n = 0; n < 6; ++n) {
    const double m = n == 5 ? top : 1;
    world.add({.x = Vec3(0.01 * n, 0, 0.1 + 0.2 * n),
               .v = Vec3(0.1 * n, 0.05, 0),
               .mass = m,
               .principal = Vec3::Constant(m * 0.04 / 6),
               .half_sides = Vec3::Constant(0.1)});
  }
  world.step(1.0 / 60);
  return world;
}

TEST(Anderson, HasTheAnswerOfSweepsAfterFewer) {
  const StopRule stop{.max_sweeps = 100'000, .tolerance = 1e-10};
  const struct {
    std::string name;
    Solver<6> plain, accelerated;
  } models[] = {{"box", gauss_seidel<6>(), anderson<6>(FrictionModel::box)},
                {"cone", cone_gauss_seidel<6>(), anderson<6>(FrictionModel::cone)}};
  for (const auto& [name, plain, accelerated] : models) {
    const World<6> slow = pushed_tower(plain, stop), fast = pushed_tower(accelerated, stop);
    ASSERT_TRUE(slow.solved().converged && fast.solved().converged) << name;
    // A last sweep with a change of 1e-10 m/s may be 1/(1 - ρ) times as far from the solution, for at most ten thousand
    // sweeps.
    EXPECT_LE(apart(slow, fast), 1e-6) << name;
    EXPECT_LE(4 * fast.report().iterations, slow.report().iterations) << name;
  }
}

TEST(Anderson, IsWithinTheBoundsWheneverItStops) {
  for (int sweeps = 1; sweeps <= 40; ++sweeps) {
    const World<6> box = pushed_tower(anderson<6>(FrictionModel::box), {.max_sweeps = sweeps}, 1000);
    EXPECT_EQ(box.report().iterations, sweeps);
    for (const Row<6>& row : box.rows()) EXPECT_TRUE(row.lo <= row.lambda && row.lambda <= row.hi);
    const World<6> on_cones = pushed_tower(anderson<6>(FrictionModel::cone), {.max_sweeps = sweeps}, 1000);
    for (std::size_t k = 0; k < on_cones.rows().size(); k += 3) {
      const double normal = on_cones.rows()[k].lambda;
      const Vec2 along(on_cones.rows()[k + 1].lambda, on_cones.rows()[k + 2].lambda);
      EXPECT_GE(normal, 0);
      EXPECT_LE(along.norm(), mu * normal * (1 + 1e-15) + 1e-300) << "row " << k << ", " << sweeps << " sweeps";
    }
  }
}

TEST(Anderson, BeginsAsSweepsDo) {
  // There is nothing to mix before the third sweep.
  for (const int sweeps : {1, 2})
    EXPECT_EQ(apart(pushed_tower(anderson<6>(FrictionModel::box), {.max_sweeps = sweeps}),
                    pushed_tower(gauss_seidel<6>(), {.max_sweeps = sweeps})),
              0);
}

TEST(Anderson, NeedsNoMoreSweepsWhateverTheLoad) {
  const StopRule stop{.max_sweeps = 100'000, .tolerance = 1e-8};
  for (const double top : {1e-3, 1.0, 1.8, 10.0, 1e2, 1e3, 1e5}) {
    const auto sweeps = [&](const Solver<6>& solver) {
      return pushed_tower(solver, stop, top).report().iterations;
    };
    EXPECT_LE(sweeps(anderson<6>(FrictionModel::box)), sweeps(gauss_seidel<6>()))
        << "under a top of " << top << " kg";
    EXPECT_LE(sweeps(anderson<6>(FrictionModel::cone)), sweeps(cone_gauss_seidel<6>()))
        << "under a top of " << top << " kg";
  }
}

}  // namespace
}  // namespace spook::anderson_test
