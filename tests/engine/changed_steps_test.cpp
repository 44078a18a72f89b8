// Steps of changing size: leapfrog's velocity belongs to the middle of its step, of whichever size.
#include <gtest/gtest.h>

#include <cmath>

#include "engine/world/world.hpp"

namespace spook::changed_steps_test {
namespace {

constexpr double g = 9.81;

TEST(ChangedSteps, KeepTheHeightOfAnElasticBall) {
  // A ball that a long step moves into the floor is found by a short one, many of its lengths late.
  for (const double shorter : {1.0 / 144, 1.0 / 300, 1.0 / 1000, 1e-4}) {
    World<3> world({.gravity = Vec3(0, 0, -g), .impacts = ImpactLaw{.restitution = 1}});
    world.add_plane(Vec3::UnitZ(), 0);
    const double radius = 0.1, height = 1;
    const int ball = world.add({.x = Vec3(0, 0, radius + height), .mass = 1, .radius = radius});
    double h = 1.0 / 30;
    world.start_half_step_back(h);
    int impacts = 0;
    for (int n = 0; n < 2000; ++n) {
      h = n / 7 % 2 == 0 ? 1.0 / 30 : shorter;
      world.step(h);
      impacts += world.report().impacts;
      const double v = world.synchronized_velocity(ball, h).z(), z = world.x(ball).z() - radius;
      ASSERT_NEAR(z + v * v / (2 * g), height, 1e-9) << "step " << n << ", shorter steps of " << shorter;
    }
    EXPECT_GE(impacts, 20);
  }
}

TEST(ChangedSteps, LetABodyFallAsOneStepWould) {
  // The fall is ½ g t² to round-off, as with one step size, and a body at rest stays at rest.
  World<6> world({.friction = 0.5});
  world.add_plane(Vec3::UnitZ(), 0);
  const int falling = world.add({.x = Vec3(5, 0, 100), .mass = 2, .radius = 0.1}),
            resting = world.add({.x = Vec3(0, 0, 0.1), .mass = 1, .half_sides = Vec3::Constant(0.1)});
  world.start_consistently(1.0 / 60);
  for (int n = 0; n < 200; ++n) world.step(n % 3 == 0 ? 1.0 / 60 : n % 3 == 1 ? 1.0 / 240 : 1.0 / 100);
  const double t = world.time();
  EXPECT_NEAR(world.x(falling).z(), 100 - g * t * t / 2, 1e-9);
  EXPECT_NEAR(world.x(resting).z(), 0.1, 1e-4);
  EXPECT_LE(world.v(resting).norm(), 1e-3 * g / 60);
}

}  // namespace
}  // namespace spook::changed_steps_test
