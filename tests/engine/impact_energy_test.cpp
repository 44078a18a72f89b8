// Impacts add no energy, and with e = 1 and free bodies they take none: whatever bodies an impact brings together within
// its step, and whatever joints they have.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "engine/bodies/conserved_quantities.hpp"
#include "engine/world/world.hpp"
#include "random_input.hpp"

namespace spook::impact_energy_test {
namespace {

constexpr double g = 9.81;

/// Kinetic and potential energy, with velocities as they are stored [J].
double energy_of(const World<6>& world) {
  return kinetic_energy(world.bodies()) + potential_energy(world.bodies(), world.settings().gravity);
}

TEST(ImpactEnergy, IsKeptByBallsThatFollowEachOtherClosely) {
  // The first ball bounces off the wall, and has passed the gap to the next one before its step ends. Their contact is
  // found after the first impact, in the same step.
  for (const int balls : {2, 5})
    for (const double gap : {0.001, 0.01, 0.05})
      for (const double h : {1.0 / 30, 1.0 / 60, 1.0 / 240}) {
        World<6> world({.gravity = Vec3::Zero(), .impacts = ImpactLaw{.restitution = 1}});
        world.add_plane(Vec3::UnitZ(), 0);
        for (int n = 0; n < balls; ++n)
          world.add({.x = Vec3(0, 0, 1 + n * (0.2 + gap)), .v = Vec3(0, 0, -4.4), .mass = 1, .radius = 0.1});
        const double before = energy_of(world);
        for (int n = 0; n < 2 / h; ++n) world.step(h);
        const auto what = ::testing::Message() << balls << " balls, gaps of " << gap << ", h " << h;
        EXPECT_NEAR(energy_of(world) / before, 1, 1e-9) << what;
        // Equal balls exchange their velocities, so that each returns as fast as it came.
        for (int b = 1; b <= balls; ++b) EXPECT_NEAR(world.v(b).z(), 4.4, 1e-9) << what << ", ball " << b;
      }
}

TEST(ImpactEnergy, IsKeptByAGasOfBalls) {
  const unsigned seed = std::random_device()();
  SCOPED_TRACE("seed " + std::to_string(seed));
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> number(-1, 1);
  World<6> world({.gravity = Vec3::Zero(), .impacts = ImpactLaw{.restitution = 1}});
  for (const Vec3& inwards :
       {Vec3(1, 0, 0), Vec3(-1, 0, 0), Vec3(0, 1, 0), Vec3(0, -1, 0), Vec3(0, 0, 1), Vec3(0, 0, -1)})
    world.add_plane(inwards, -0.75);
  for (int n = 0; n < 27; ++n)
    world.add({.x = 0.45 * Vec3(n % 3 - 1, n / 3 % 3 - 1, n / 9 - 1),
               .v = 2 * Vec3(number(random), number(random), number(random)),
               .mass = std::exp(number(random)),
               .radius = 0.1});
  const double before = energy_of(world);
  std::int64_t impacts = 0;
  for (int n = 0; n < 300; ++n) {
    world.step(1.0 / 60);
    impacts += world.report().impacts;
  }
  EXPECT_GE(impacts, 100);
  // Three balls that meet within one step may be resolved in another order than that of their meetings, which changes
  // velocities and no energy. A rare pair is left to its rows, and loses a little.
  EXPECT_NEAR(energy_of(world) / before, 1, 0.02);
}

TEST(ImpactEnergy, IsNeverAddedWhereJointsTakePart) {
  // Two capsules or boxes on a joint fall on a floor, and turn fast. Joints do not bounce, contacts do. A rope may be slack.
  const unsigned seed = std::random_device()();
  SCOPED_TRACE("seed " + std::to_string(seed));
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> number(-1, 1);
  const Quat lying(Eigen::AngleAxisd(std::numbers::pi / 2, Vec3::UnitY()));
  for (const JointKind kind :
       {JointKind::rope, JointKind::hinge, JointKind::ball, JointKind::weld, JointKind::slider})
    for (const double e : {0.3, 0.5, 1.0})
      for (const double h : {1.0 / 60, 1.0 / 240})
        for (int trial = 0; trial < 6; ++trial) {
          World<6> world({.friction = 0.3, .impacts = ImpactLaw{.restitution = e, .friction = 0.3}});
          world.add_plane(Vec3::UnitZ(), 0);
          for (int n = 0; n < 2; ++n) {
            Body<6> body{.x = Vec3(n, 0, 2), .v = 3 * Vec3(number(random), number(random), 0)};
            body.mass = n == 1 && trial % 2 == 1 ? 100 : 1;
            body.q = lying;
            body.omega = 6 * Vec3(number(random), number(random), number(random));
            if (number(random) < 0) {
              body.radius = 0.1;
              body.half_length = 0.3;
            } else {
              body.half_sides = Vec3(0.1, 0.15, 0.4);
            }
            world.add(body);
          }
          const bool rope = kind == JointKind::rope;
          const double arm = rope ? 0.4 : 0.5;
          Joint joint{.i = 1, .j = 2, .p_i = Vec3(0, 0, arm), .p_j = Vec3(0, 0, -arm), .kind = kind};
          if (rope) joint.length = trial < 3 ? 0.2 : 0.4;
          if (kind == JointKind::hinge) joint.axis = Vec3::UnitX();
          world.add_joint(joint);
          world.step(h);  // in it joints stop what opens them
          const double before = energy_of(world);
          double most = before;
          for (int n = 0; n < 2.5 / h; ++n) {
            world.step(h);
            most = std::max(most, energy_of(world));
          }
          // Velocities are half a step old: the energy is uncertain by the work of gravity in that time.
          EXPECT_LE(most, 1.05 * before + 101 * g * 5 * h)
              << name_of(kind) << ", e " << e << ", h " << h << ", trial " << trial;
        }
}

TEST(ImpactEnergy, IsNotMadeOfOverlapsWithFriction) {
  // Boxes, balls and capsules begin in one place. They part without a shot, though a cone problem of bodies that overlap
  // so much may have no solution.
  const unsigned seed = std::random_device()();
  SCOPED_TRACE("seed " + std::to_string(seed));
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> number(-1, 1);
  for (int trial = 0; trial < 40; ++trial) {
    const double mu = 0.3 + 0.5 * (trial % 2), h = trial % 3 == 0 ? 1.0 / 60 : 1.0 / 240, size = 0.24;
    World<6> world({.friction = mu});
    world.add_plane(Vec3::UnitZ(), 0);
    for (int n = 0; n < 8; ++n) {
      Body<6> body{.x = Vec3(0.01 * number(random), 0.01 * number(random), 2 * size + 0.01 * number(random))};
      body.mass = 100;
      body.q = Quat(number(random), number(random), number(random), number(random)).normalized();
      if (n % 3 == 0) {
        body.half_sides = Vec3::Constant(size);
      } else {
        body.radius = size / 2;
        if (n % 3 == 1) body.half_length = 2 * size / 3;
      }
      world.add(body);
    }
    double most = 0;
    for (int n = 0; n < 0.5 / h; ++n) {
      world.step(h);
      most = std::max(most, kinetic_energy(world.bodies()));
    }
    // The recovery lifts bodies, and they fall again: a fall by some sizes each.
    EXPECT_LE(most, 8 * 100 * g * 6 * size) << "trial " << trial << ", friction " << mu << ", h " << h;
  }
}

}  // namespace
}  // namespace spook::impact_energy_test
