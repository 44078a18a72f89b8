// Steps in parts: joints hold while bodies rotate fast, or carry heavy loads, with default settings.
#include "engine/constraints/step_parts.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "engine/bodies/conserved_quantities.hpp"
#include "engine/diagnostics/run_check.hpp"
#include "engine/world/world.hpp"
#include "random_input.hpp"

namespace spook::step_parts_test {
namespace {

constexpr double g = 9.81;
constexpr double steps_to_try[] = {1.0 / 30, 1.0 / 60, 1.0 / 240, 1.0 / 1000};

/// Runs a world; returns the largest value of `seen` after a step.
template <int Dof, class Seen>
double largest(World<Dof>& world, double h, double time, const Seen& seen) {
  RunCheck<Dof> check;
  check.look(world, h);
  double most = 0;
  while (world.time() < time) {
    world.step(h);
    check.look(world, h);
    most = std::max(most, seen());
  }
  EXPECT_EQ(check.verdict().state, State::sound) << check.verdict().reason << ", h = " << h;
  return most;
}

TEST(StepParts, HoldAMassThatIsWhirled) {
  // A part turns the rod by α <= 0.12, and its end leaves the circle by α²/2.
  for (const double h : steps_to_try)
    for (const double speed : {6.0, 60.0, 100.0}) {
      World<6> world({.gravity = Vec3::Zero()});
      world.add_fixed(Vec3::Zero());
      const int mass =
          world.add({.x = Vec3(1, 0, 0), .v = Vec3(0, speed, 0), .mass = 1, .principal = Vec3::Constant(0.01)});
      world.add_joint({.i = 0, .j = mass, .length = 1});
      const double off = largest(world, h, 1, [&] { return std::abs(world.x(mass).norm() - 1); });
      EXPECT_LE(off, 1e-2) << speed << " rad/s, h = " << h;
      EXPECT_NEAR(world.v(mass).norm(), speed, 1e-2 * speed);
    }
}

TEST(StepParts, HoldAnArmThatIsWhirled) {
  for (const double h : steps_to_try)
    for (const double speed : {6.0, 60.0, 100.0}) {
      World<6> world({.gravity = Vec3::Zero()});
      world.add_fixed(Vec3::Zero());
      const int arm = world.add({.x = Vec3(0.5, 0, 0),
                                 .v = Vec3(0, 0.5 * speed, 0),
                                 .mass = 1,
                                 .omega = Vec3(0, 0, speed),
                                 .principal = Vec3(0.01, 0.1, 0.1)});
      world.add_joint({.i = 0, .j = arm, .p_j = Vec3(-0.5, 0, 0)});
      const double off = largest(world, h, 1, [&] { return std::abs(world.x(arm).norm() - 0.5); });
      EXPECT_LE(off, 1e-2 * 0.5) << speed << " rad/s, h = " << h;
      EXPECT_NEAR(angular_velocity(world, arm).z(), speed, 1e-2 * speed) << "h = " << h;
    }
}

TEST(StepParts, HoldALightRodUnderAHeavyLoad) {
  // Nail, rod, 0.1 kg, rod, load: the load swings as a pendulum of both rods, sqrt(L/g) v to each side.
  for (const double h : steps_to_try)
    for (const double load : {1.0, 10.0, 100.0}) {
      World<3> world({});
      world.add_fixed(Vec3::Zero());
      world.add({.x = Vec3(0, 0, -0.1), .mass = 0.1});
      const int end = world.add({.x = Vec3(0, 0, -0.2), .v = Vec3(0.1, 0, 0), .mass = load});
      world.add_joint({.i = 0, .j = 1, .length = 0.1});
      world.add_joint({.i = 1, .j = end, .length = 0.1});
      const double off = largest(world, h, 5, [&] {
        return std::max(std::abs(world.x(1).norm() - 0.1), std::abs((world.x(end) - world.x(1)).norm() - 0.1));
      });
      EXPECT_LE(off, 1e-3 * 0.1) << load << " kg, h = " << h;
      const double energy = world.v(end).squaredNorm() / 2 + g * (world.x(end).z() + 0.2);
      EXPECT_LE(energy, 1.1 * 0.1 * 0.1 / 2) << load << " kg, h = " << h;
    }
}

TEST(StepParts, HoldAChainOfRigidLinks) {
  for (const double h : steps_to_try)
    for (const double load : {1.0, 100.0}) {
      World<6> world({});
      world.add_fixed(Vec3::Zero());
      const int links = 10;
      for (int n = 0; n < links; ++n) {
        const int link =
            world.add({.x = Vec3(0, 0, -0.1 * n - 0.05), .mass = 0.1, .principal = Vec3(8.3e-5, 8.3e-5, 1e-5)});
        world.add_joint({.i = link - 1,
                         .j = link,
                         .p_i = n == 0 ? Vec3::Zero() : Vec3(0, 0, -0.05),
                         .p_j = Vec3(0, 0, 0.05)});
      }
      const int end = world.add(
          {.x = Vec3(0, 0, -1.1), .v = Vec3(1, 0, 0), .mass = load, .principal = Vec3::Constant(0.004 * load)});
      world.add_joint({.i = links, .j = end, .p_i = Vec3(0, 0, -0.05), .p_j = Vec3(0, 0, 0.1)});
      const double reach = largest(world, h, 2, [&] { return world.x(end).norm(); });
      EXPECT_LE(reach, 1.1 * (1 + 1e-3)) << load << " kg, h = " << h;
    }
}

TEST(StepParts, LetAGyroscopePrecess) {
  // About a vertical axis the wheel precesses at Ω with m g r = (I_a ω - (I_t + m r² - I_a) Ω) Ω. Its own axis is
  // level, and the second term vanishes: Ω = m g r/(I_a ω).
  const double spin = 100, r = 0.3, axial = 0.02, across = 0.012;
  const double rate = g * r / (axial * spin);
  for (const double h : {1.0 / 60, 1.0 / 240, 1.0 / 1000}) {
    World<6> world({});
    world.add_fixed(Vec3::Zero());
    const int wheel = world.add({.x = Vec3(r, 0, 0),
                                 .v = Vec3(0, rate * r, 0),
                                 .mass = 1,
                                 .omega = Vec3(spin, 0, rate),
                                 .principal = Vec3(axial, across, across)});
    world.add_joint({.i = 0, .j = wheel, .p_j = Vec3(-r, 0, 0)});
    const double off = largest(world, h, 1, [&] { return std::abs(world.x(wheel).norm() - r); });
    EXPECT_LE(off, 1e-2 * r) << "h = " << h;
    EXPECT_NEAR(std::atan2(world.x(wheel).y(), world.x(wheel).x()), rate * world.time(), 1e-2 * rate)
        << "h = " << h;
  }
}

/// A chain of rods of 1 m and 1 kg, in random directions from a nail. Its last rod has a random mass up to `load` [kg].
World<6> random_chain(testing::Random& random, double load) {
  World<6> world({});
  world.add_fixed(Vec3::Zero());
  const int rods = random.integer(2, 4);
  Vec3 end = Vec3::Zero();
  for (int n = 0; n < rods; ++n) {
    const Vec3 along = random.unit_vector();
    const double mass = n + 1 == rods ? random.log_uniform(1, load) : 1;
    const int rod = world.add({.x = end + 0.5 * along,
                               .mass = mass,
                               .q = Quat::FromTwoVectors(Vec3::UnitZ(), along),
                               .principal = mass * Vec3(1.0 / 12, 1.0 / 12, 0.01)});
    world.add_joint({.i = n, .j = rod, .p_i = Vec3(0, 0, n > 0 ? 0.5 : 0), .p_j = Vec3(0, 0, -0.5)});
    end += along;
  }
  return world;
}

TEST(StepParts, GiveChainsThatSnapTautNoEnergy) {
  // Falling from rest, a chain of light rods snaps taut, and its heavy end stops it for a moment. Energy is that at a
  // position, with the mean kinetic energy of half a step before and after. A heavy, fast ball beside it has far more
  // energy, which is not counted, and changes nothing.
  testing::Random random;
  for (const double load : {1.0, 100.0, 1000.0})
    for (const double h : steps_to_try)
      for (int chain = 0; chain < 12; ++chain) {
        World<6> world = random_chain(random, load);
        const double rods = static_cast<double>(world.joints().size());
        const double weight = g * std::accumulate(world.bodies().mass.begin(), world.bodies().mass.end(), 0.0);
        const auto beside = static_cast<std::size_t>(
            world.add({.x = Vec3(1e3, 0, 0), .v = Vec3(1e3, 0, 0), .mass = 1e6, .radius = 0.1}));
        const auto sum = [&](const auto& energy) {
          double total = 0;
          for (std::size_t i = 0; i < beside; ++i) total += energy(i);
          return total;
        };
        const Bodies<6>& bodies = world.bodies();
        const auto height = [&] { return sum([&](auto i) { return bodies.mass[i] * g * bodies.x[i].z(); }); };
        const auto kinetic = [&] {
          return sum([&](auto i) { return kinetic_energy(bodies, i, bodies.motion.W[i]); });
        };
        const double start = height();
        double T = 0, U = start, gained = 0, gap = 0;
        while (world.time() < 1.5) {
          world.step(h);
          const double T_after = kinetic();
          gained = std::max(gained, (T + T_after) / 2 + U - start);
          T = T_after;
          U = height();
          for (const Joint& joint : world.joints())
            gap = std::max(gap, gap_of(joint, world.bodies()).apart.norm());
        }
        EXPECT_LE(gained, 0.02 * weight * rods) << "load " << load << ", h = " << h << ", chain " << chain;
        EXPECT_NEAR(world.time(), static_cast<double>(world.steps()) * h, 1e-9);
        EXPECT_LE(gap, 0.1) << "load " << load << ", h = " << h << ", chain " << chain;
      }
}

TEST(StepParts, AreOneForSlowOrSoftJoints) {
  World<6> world({});
  world.add_fixed(Vec3::Zero());
  const int bob = world.add({.x = Vec3(1, 0, 0), .mass = 1, .radius = 0.1});
  world.add_joint({.i = 0, .j = bob, .length = 1});
  for (int n = 0; n < 100; ++n) {
    world.step(1.0 / 60);
    ASSERT_EQ(world.parts(), 1);
  }
  // A given k is a deliberate spring, with the step that belongs to it.
  World<6> soft({.gravity = Vec3::Zero(), .k = 1e6});
  soft.add_fixed(Vec3::Zero());
  soft.add({.x = Vec3(1, 0, 0), .v = Vec3(0, 60, 0), .mass = 1, .radius = 0.1});
  soft.add_joint({.i = 0, .j = 1, .length = 1});
  soft.step(1.0 / 60);
  EXPECT_EQ(soft.parts(), 1);
}

TEST(StepParts, BecomeFewerAgain) {
  World<6> world({.gravity = Vec3::Zero()});
  world.add_fixed(Vec3::Zero());
  const int mass = world.add({.x = Vec3(1, 0, 0), .v = Vec3(0, 50, 0), .mass = 1, .radius = 0.1});
  world.add_joint({.i = 0, .j = mass, .length = 1});
  world.step(1.0 / 60);
  EXPECT_EQ(world.parts(), 8);
  world.place(mass, Vec3(1, 0, 0), Vec3(0, 1, 0));
  for (int n = 0; n < 400; ++n) world.step(1.0 / 60);
  EXPECT_EQ(world.parts(), 1);
}

TEST(StepParts, CountAsOneStep) {
  World<6> world({.gravity = Vec3::Zero()});
  world.add_fixed(Vec3::Zero());
  world.add({.x = Vec3(1, 0, 0), .v = Vec3(0, 60, 0), .mass = 1, .radius = 0.1});
  world.add_joint({.i = 0, .j = 1, .length = 1});
  for (int n = 0; n < 60; ++n) world.step(1.0 / 60);
  EXPECT_EQ(world.steps(), 60);
  EXPECT_NEAR(world.time(), 1, 1e-12);
  // m v²/r, with any number of parts; each part has it to α²/2.
  EXPECT_NEAR(world.joint_force(0).norm(), 3600, 0.02 * 3600);
}

TEST(StepParts, KeepBodiesWithoutJointsExact) {
  // The first step computes the forces of joints. It must leave no trace in bodies without joints.
  for (const bool shifted : {false, true}) {
    const double h = 1.0 / 64;
    World<6> world({});
    world.add_fixed(Vec3::Zero());
    const int mass = world.add({.x = Vec3(1, 0, 0), .v = Vec3(0, 60, 0), .mass = 1, .radius = 0.1});
    world.add_joint({.i = 0, .j = mass, .length = 1});
    const int falling = world.add({.x = Vec3(9, 0, 0), .mass = 1, .radius = 0.1});
    if (shifted) world.start_half_step_back(h);
    EXPECT_EQ(world.joint_force(0), Vec3(Vec3::Zero())) << "no step was taken";
    for (int n = 0; n < 64; ++n) world.step(h);
    ASSERT_GT(world.parts(), 1);
    // Leapfrog is exact here, Eq. (1.6); without the start it is ahead by g h t/2 with the h of a part, Eq. (1.7).
    const double part = h / world.parts(), ahead = shifted ? 0 : part / 2;
    EXPECT_NEAR(world.x(falling).z(), -g * (0.5 + ahead), 1e-12) << (shifted ? "shifted" : "not shifted");
    EXPECT_NEAR(world.synchronized_velocity(falling, h).z(), -g * (1 + ahead), 1e-12);
  }
}

TEST(StepParts, RefuseNumbersThatAreNoPowersOfTwo) {
  for (const int parts : {0, -1, 3, 2048}) EXPECT_THROW(World<6>({.max_parts = parts}), std::invalid_argument);
}

}  // namespace
}  // namespace spook::step_parts_test
