// Impacts of bodies on joints: closed forms of one degree of freedom, and energy.
#include "engine/impacts/impact_joints.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "engine/bodies/conserved_quantities.hpp"
#include "engine/diagnostics/run_check.hpp"
#include "engine/world/world.hpp"

namespace spook {
namespace {

World<6> bouncy(double e, double mu = 0, const Vec3& gravity = Vec3(0, 0, -9.81)) {
  return World<6>({.gravity = gravity, .friction = mu, .impacts = ImpactLaw{.restitution = e, .friction = mu}});
}

double largest_gap(const World<6>& world) {
  double largest = 0;
  for (const Joint& joint : world.joints())
    largest = std::max(largest, gap_of(joint, world.bodies()).apart.norm());
  return largest;
}

// The bob falls from the height of its nail, and hits a wall where the pendulum hangs down: ω' = -e ω, so it rises to e²
// of the height. A step late is some two per cent of its way.
TEST(ImpactJoints, APendulumBouncesOffAWall) {
  for (const double h : {1.0 / 60, 1.0 / 240, 1.0 / 1000})
    for (const double e : {0.0, 0.3, 0.8, 1.0}) {
      SCOPED_TRACE(::testing::Message() << "h " << h << ", e " << e);
      World<6> world = bouncy(e);
      const int nail = world.add_fixed(Vec3(0, 0, 2));
      world.add_fixed(Vec3(-0.2, 0, 1), Cuboid{Vec3(0.1, 1, 0.5)}, Quat::Identity());
      const int bob = world.add({.x = Vec3(1, 0, 2), .mass = 2, .half_sides = Vec3::Constant(0.1)});
      world.add_joint({.i = nail, .j = bob, .p_j = Vec3(-1, 0, 0)});
      RunCheck<6> check;
      check.look(world, h);
      double gap = 0, highest = 0, hit = 0;
      while (world.time() < 1.8) {
        world.step(h);
        check.look(world, h);
        gap = std::max(gap, largest_gap(world));
        if (hit == 0 && world.report().impacts > 0) hit = world.time();
        if (hit > 0) highest = std::max(highest, world.x(bob).z());
      }
      EXPECT_NEAR(highest, 1 + e * e, 0.01);
      // A correction of at most (1 + e) u h along the tangent, with u = 4.43 m/s; 6 h² is the gap while it swings.
      EXPECT_LT(gap, std::pow((1 + e) * 4.43 * h, 2) / 2 + 6 * h * h);
      EXPECT_EQ(check.verdict().state, State::sound) << check.verdict().reason;
    }
}

// A plate on a weld is ground.
TEST(ImpactJoints, ABallBouncesOffAPlateOnAWeldAsOffTheGround) {
  for (const double h : {1.0 / 60, 1.0 / 1000}) {
    double highest[2] = {0, 0};
    for (const bool welded : {false, true}) {
      World<6> world = bouncy(0.8);
      const int ground = world.add_fixed(Vec3::Zero());
      if (welded) {
        const int plate = world.add({.x = Vec3(0, 0, 1), .mass = 2, .half_sides = Vec3(0.5, 0.5, 0.05)});
        world.add_joint({.i = ground, .j = plate, .p_i = Vec3(0, 0, 1), .kind = JointKind::weld});
      } else {
        world.add_fixed(Vec3(0, 0, 1), Cuboid{Vec3(0.5, 0.5, 0.05)}, Quat::Identity());
      }
      const int ball = world.add({.x = Vec3(0.2, 0, 2.15), .mass = 1, .radius = 0.1});
      bool hit = false;
      while (world.time() < 1) {
        world.step(h);
        hit = hit || world.report().impacts > 0;
        if (hit) highest[welded] = std::max(highest[welded], world.x(ball).z() - 1.15);
      }
    }
    EXPECT_NEAR(highest[0], 0.64, 1e-3) << h;
    EXPECT_NEAR(highest[1], highest[0], 1e-4) << h;
  }
}

// A ball hits a rod on a hinge, of inertia I about it, at the distance r: J = (1 + e) u / (1/m + r²/I). The hinge's own Σ
// is 1e-7 of the diagonal.
TEST(ImpactJoints, ARodOnAHingeHasItsInertiaAboutTheHinge) {
  constexpr double M = 3, m = 1, r = 0.8, u = 2;
  for (const double e : {0.5, 1.0}) {
    World<6> world = bouncy(e, 0, Vec3::Zero());
    const int ground = world.add_fixed(Vec3::Zero());
    const int rod = world.add({.x = Vec3(0.5, 0, 0), .mass = M, .half_sides = Vec3(0.5, 0.05, 0.05)});
    world.add_joint(
        {.i = ground, .j = rod, .p_j = Vec3(-0.5, 0, 0), .kind = JointKind::hinge, .axis = Vec3::UnitY()});
    const int ball = world.add({.x = Vec3(r, 0, 0.65), .v = Vec3(0, 0, -u), .mass = m, .radius = 0.1});
    while (world.report().impacts == 0 && world.time() < 0.5) world.step(1.0 / 240);
    const double I = M * 1.01 / 12 + M / 4, J = (1 + e) * u / (1 / m + r * r / I);
    EXPECT_NEAR(world.v(ball).z(), -u + J / m, 1e-6) << e;
    EXPECT_NEAR(world.bodies().motion.W[static_cast<std::size_t>(rod)](4), J * r / I, 1e-5) << e;
  }
}

// The energy of 20 links and a ball is that of the ball, with friction at most that.
TEST(ImpactJoints, AChainThatIsHitGainsNoEnergy) {
  for (const double mu : {0.0, 0.5}) {
    World<6> world = bouncy(1, mu, Vec3::Zero());
    int last = world.add_fixed(Vec3::Zero());
    for (int n = 0; n < 20; ++n) {
      const int link =
          world.add({.x = Vec3(0, 0, -0.1 - 0.2 * n), .mass = 1, .half_sides = Vec3(0.02, 0.02, 0.08)});
      const Vec3 end = n == 0 ? Vec3::Zero() : Vec3(0, 0, -0.1);
      world.add_joint({.i = last, .j = link, .p_i = end, .p_j = Vec3(0, 0, 0.1)});
      world.exclude_contacts({last, link});
      last = link;
    }
    world.add({.x = Vec3(-0.52, 0, -3.95), .v = Vec3(2, 0, 0), .mass = 0.5, .radius = 0.1});
    while (world.report().impacts == 0 && world.time() < 0.5) world.step(1.0 / 240);
    EXPECT_LE(kinetic_energy(world.bodies()), 1 + 1e-9);
    EXPECT_GE(kinetic_energy(world.bodies()), 1 - 1e-6) << "the hit is along the normal: friction takes little";
  }
}

// A distance as soft as a thread of rubber does not stop the ball that it holds: its Σ is far above 1/m.
TEST(ImpactJoints, ASoftSpringTakesNoImpulse) {
  World<6> world = bouncy(1, 0, Vec3::Zero());
  const int nail = world.add_fixed(Vec3(0, 0, 2));
  world.add_fixed(Vec3(0, 0, -1), Cuboid{Vec3(1, 1, 1)}, Quat::Identity());
  const int ball = world.add({.x = Vec3(0, 0, 0.5), .v = Vec3(0, 0, -2), .mass = 1, .radius = 0.1});
  world.add_joint({.i = nail, .j = ball, .length = 1.5, .k = 1e-3, .d = 0});
  while (world.report().impacts == 0 && world.time() < 0.5) world.step(1.0 / 60);
  EXPECT_NEAR(world.v(ball).z(), 2, 1e-3);
}

// Five balls that welds connect land flat: their five impacts are of one time, and one problem. One after the other they
// would turn the row, and the impulse at its end would make the next ball separate before its turn.
TEST(ImpactJoints, ARowOfWeldedBallsThatLandsFlatStaysFlat) {
  for (const double h : {1.0 / 60, 1.0 / 240})
    for (const double e : {0.2, 0.5, 1.0}) {
      SCOPED_TRACE(::testing::Message() << "h " << h << ", e " << e);
      World<6> world = bouncy(e, 0.3);
      world.add_plane(Vec3::UnitZ(), 0);
      std::vector<int> row;
      for (int n = 0; n < 5; ++n) {
        row.push_back(world.add({.x = Vec3(0.2 * n, 0, 0.6), .mass = 1, .radius = 0.1}));
        if (n == 0) continue;
        const int before = row[static_cast<std::size_t>(n) - 1];
        world.add_joint({.i = before,
                         .j = row.back(),
                         .p_i = Vec3(0.1, 0, 0),
                         .p_j = Vec3(-0.1, 0, 0),
                         .kind = JointKind::weld});
        world.exclude_contacts({before, row.back()});
      }
      while (world.report().impacts == 0 && world.time() < 1) world.step(h);
      const double fall = std::sqrt(2 * 9.81 * 0.5);
      double least = infinity, most = 0;
      for (const int ball : row) {
        least = std::min(least, world.v(ball).z());
        most = std::max(most, world.v(ball).z());
      }
      EXPECT_NEAR(least, e * fall, 2 * 9.81 * h) << "gravity acts in the step, too";
      EXPECT_LE(most - least, 1e-6 * fall);
      for (const Impact& impact : world.impacts()) EXPECT_GT(impact.speed, 0);
      EXPECT_EQ(world.report().impacts, 5);
    }
}

}  // namespace
}  // namespace spook
