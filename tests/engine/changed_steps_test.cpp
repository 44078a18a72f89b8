// Steps of changing size: leapfrog's velocity belongs to the middle of its step, of whichever size.
#include <gtest/gtest.h>

#include <cmath>

#include "engine/world/world.hpp"

namespace spook::changed_steps_test {
namespace {

constexpr double g = 9.81, longer = 1.0 / 60;

Body<6> ball_at(const Vec3& x) {
  return {.x = x, .mass = 1, .radius = 0.1};
}

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

TEST(ChangedSteps, MayBeginWithASuccessor) {
  // Velocities lag by half of the last step, which the successor must know.
  World<6> first({});
  const int n = first.add(ball_at(Vec3(0, 0, 100)));
  first.start_half_step_back(longer);
  for (int step = 0; step < 30; ++step) first.step(longer);
  World<6> next({});
  next.add(ball_at(Vec3(0, 0, 100)));
  next.take_state_from(first);
  for (int step = 0; step < 30; ++step) next.step(longer / 3);
  const double t = next.time();
  EXPECT_NEAR(next.x(n).z(), 100 - g * t * t / 2, 1e-10);
}

TEST(ChangedSteps, ShiftASpinLikeASpeed) {
  // τ = I α turns a ball by α t²/2, whatever the steps.
  const double torque = 0.01;
  World<6> world({.gravity = Vec3::Zero(), .wrench = [=](auto, const auto&, double) {
                    Twist<6> wrench = Twist<6>::Zero();
                    wrench[5] = torque;
                    return wrench;
                  }});
  const int n = world.add(ball_at(Vec3::Zero()));
  const double alpha = torque * world.bodies().orientations.inverse_inertia(0)(0, 0);
  world.start_half_step_back(longer / 4);
  for (int step = 0; step < 60; ++step) world.step(step % 3 == 0 ? longer / 4 : longer / 10);
  const double lag = world.velocity_lag(longer / 10);
  EXPECT_NEAR(angular_velocity(world, n).z(), alpha * (world.time() - lag), 1e-9 * alpha);
}

TEST(ChangedSteps, ShiftWhatFallsBesideAContactOfSoftSteps) {
  World<6> world({.soft_steps = SoftSteps{.substeps = 2}});
  world.add_plane(Vec3::UnitZ(), 0);
  world.add(ball_at(Vec3(0, 0, 0.1)));
  const int falling = world.add(ball_at(Vec3(5, 0, 100)));
  world.start_half_step_back(longer);
  for (int n = 0; n < 100; ++n) world.step(n % 2 == 0 ? longer : longer / 4);
  const double t = world.time();
  EXPECT_NEAR(world.x(falling).z(), 100 - g * t * t / 2, 1e-9);
}

}  // namespace
}  // namespace spook::changed_steps_test
