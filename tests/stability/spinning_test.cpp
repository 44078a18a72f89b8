// Bodies that spin fast.
#include <algorithm>

#include "engine/bodies/conserved_quantities.hpp"
#include "stepping.hpp"

namespace spook {
namespace {

using testing::step_on;

World<6> top(const Vec3& omega, const RotationRule<6>& rule) {
  World<6> world({.gravity = Vec3::Zero(), .rotation = rule});
  world.add({.q = Quat(1, 2, 3, 4).normalized(), .omega = omega, .principal = Vec3(1, 2, 3)});
  return world;
}

TEST(Spin, BySplittingKeepsLAndSoBoundsTheEnergyForAnyStep) {
  for (const double spin : {1.0, 20.0, 200.0})
    for (const double h : {1.0 / 1000, 1.0 / 60, 1.0 / 30}) {
      World<6> world = top(spin * Vec3(1, 2, -2) / 3, {RotationUpdate::splitting});
      const Vec3 L = angular_momentum(world.bodies());
      const int steps = 5000;
      double lowest = infinity, highest = 0;
      EXPECT_EQ(step_on(world, h, steps,
                        [&] {
                          lowest = std::min(lowest, kinetic_energy(world.bodies()));
                          highest = std::max(highest, kinetic_energy(world.bodies()));
                        }),
                steps);
      const double roundings = 4 * steps * 2.2e-16;  // a few a step, possibly all in one direction
      EXPECT_LE((angular_momentum(world.bodies()) - L).norm(), roundings * L.norm())
          << spin << " rad/s, h " << h;
      // For a given |L| the energy is that of a spin about an axis between the first and the third.
      EXPECT_GE(lowest, L.squaredNorm() / 6 * (1 - 2 * roundings));
      EXPECT_LE(highest, L.squaredNorm() / 2 * (1 + 2 * roundings));
    }
}

TEST(Spin, WithAnExplicitTorqueIsFiniteOrReported) {
  for (const RotationUpdate update : {RotationUpdate::first_order, RotationUpdate::exponential})
    for (const double spin : {1.0, 20.0, 200.0})
      for (const double h : {1.0 / 1000, 1.0 / 60, 1.0 / 30}) {
        World<6> world = top(spin * Vec3(1, 2, -2) / 3, {update, true});
        step_on(world, h, 5000);
      }
}

TEST(Spin, WithoutTheTorqueKeepsOmega) {
  for (const RotationUpdate update : {RotationUpdate::first_order, RotationUpdate::exponential}) {
    const Vec3 omega = 200 * Vec3(1, 2, -2) / 3;
    World<6> world = top(omega, {update, false});
    EXPECT_EQ(step_on(world, 1.0 / 30, 5000), 5000);
    EXPECT_EQ(angular_velocity(world, 0), omega);
    EXPECT_NEAR(orientation(world, 0).norm(), 1, 1e-15);
  }
}

}  // namespace
}  // namespace spook
