// Recovery: overlaps and impacts without restitution leave no velocity, Eq. (7.17).
#include "engine/solvers/recovery.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "engine/bodies/conserved_quantities.hpp"
#include "engine/world/world.hpp"
#include "random_input.hpp"
#include "scenes/number.hpp"

namespace spook::recovery_test {
namespace {

constexpr double g = 9.81;
constexpr double steps_to_try[] = {1.0 / 30, 1.0 / 60, 1.0 / 240, 1.0 / 1000};

/// The remaining fraction of an overlap after a step, 1 - a h, with the relaxation of contacts.
constexpr double share_left = 1 - 4 / (1 + 4 * relaxation_of_contacts);

/// The second solve leaves a thousandth of the speed that it stops; gravity adds |g| h in a step, of which a hundredth
/// is ignored.
double ignored(double h) {
  return 2e-2 * g * h;
}

World<6> on_a_floor(double friction = 0.5) {
  World<6> world({.friction = friction});
  world.add_plane(Vec3::UnitZ(), 0);
  return world;
}

TEST(Recovery, LeavesNoReboundOfAFall) {
  const Body<6> bodies[] = {{.mass = 1, .radius = 0.5},
                            {.mass = 1, .radius = 0.5, .half_length = 0.25},
                            {.mass = 1, .half_sides = Vec3::Constant(0.5)}};
  for (const double height : {0.01, 1.0, 10.0, 100.0})
    for (const double h : steps_to_try)
      for (Body<6> body : bodies) {
        World<6> world = on_a_floor();
        body.x.z() = 0.5 + body.half_length + height;
        const int falling = world.add(body);
        double fastest = 0, rebound = 0;
        while (world.time() < std::sqrt(2 * height / g) + 1) {
          world.step(h);
          fastest = std::max(fastest, -world.v(falling).z());
          rebound = std::max(rebound, world.v(falling).z());
        }
        EXPECT_LE(rebound, 1e-2 * fastest + ignored(h)) << "from " << height << " m, h = " << h;
        EXPECT_NEAR(world.x(falling).z(), 0.5 + body.half_length, 1e-3) << "from " << height << " m, h = " << h;
      }
}

TEST(Recovery, MovesAnOverlapApartWithoutSpeed) {
  for (const double h : steps_to_try)
    for (const double depth : {1e-3, 0.05, 0.2}) {
      World<6> world = on_a_floor();
      const int cube = world.add({.x = Vec3(0, 0, 0.5 - depth), .mass = 1, .half_sides = Vec3::Constant(0.5)});
      double left = depth;
      for (int n = 0; n < 100; ++n) {
        world.step(h);
        EXPECT_LE(world.v(cube).z(), 1e-2 * std::sqrt(g * depth) + ignored(h))
            << "depth " << depth << ", h = " << h;
        // Σ > 0 lets a step take less than a h of it: h² k S is 3.4 at 1/240 and 0.2 at 1/1000.
        const double now = 0.5 - world.x(cube).z();
        EXPECT_LE(now, std::max(left, 1e-3 * 0.5)) << "step " << n;
        left = now;
      }
      EXPECT_NEAR(world.x(cube).z(), 0.5, 1e-3 * 0.5) << "depth " << depth << ", h = " << h;
      EXPECT_LE(world.v(cube).norm(), ignored(h));
    }
}

TEST(Recovery, RemovesTheShareOfAnOverlapThatDSets) {
  // Without gravity k is that of joints, so that Σ is negligible beside S.
  const double h = 1.0 / 60, depth = 0.1;
  World<6> world({.gravity = Vec3::Zero()});
  world.add_plane(Vec3::UnitZ(), 0);
  const int ball = world.add({.x = Vec3(0, 0, 0.5 - depth), .mass = 1, .radius = 0.5});
  for (int n = 1; n <= 10; ++n) {
    world.step(h);
    EXPECT_NEAR(0.5 - world.x(ball).z(), depth * std::pow(share_left, n), 1e-4 * depth) << "step " << n;
    EXPECT_LE(world.v(ball).norm(), 1e-9);
  }
}

TEST(Recovery, LetsCubesThatBeginInOnePlacePart) {
  for (const double h : steps_to_try) {
    World<6> world = on_a_floor();
    std::vector<int> cubes;
    for (int n = 0; n < 8; ++n) {
      const Vec3 x(0.01 * (n % 3), 0.01 * (n % 2), 0.5 + 0.3 * n);
      cubes.push_back(world.add({.x = x, .mass = 1, .half_sides = Vec3::Constant(0.5)}));
    }
    double up = 0;
    while (world.time() < 2) {
      world.step(h);
      for (const int cube : cubes) up = std::max(up, world.v(cube).z());
    }
    EXPECT_LE(up, 1e-2 * std::sqrt(g * 0.7) + ignored(h)) << "h = " << h;
    for (int n = 0; n < 8; ++n) EXPECT_NEAR(world.x(cubes[n]).z(), 0.5 + n, 2e-2) << "h = " << h;
  }
}

TEST(Recovery, AddsNoEnergy) {
  // Boxes, balls and capsules that overlap at random, without gravity: the energy that they lose stays lost.
  testing::Random random;
  for (int trial = 0; trial < 10; ++trial) {
    World<6> world({.gravity = Vec3::Zero(), .friction = 0.5});
    for (int n = 0; n < 6; ++n) {
      Body<6> body{.mass = 1};
      body.x = random.vector(0.4);
      body.v = random.vector(1);
      if (n % 2 == 0)
        body.half_sides = Vec3::Constant(0.3);
      else
        body.radius = 0.3;
      world.add(body);
    }
    double before = kinetic_energy(world.bodies());
    for (int n = 0; n < 60; ++n) {
      world.step(1.0 / 60);
      const double after = kinetic_energy(world.bodies());
      EXPECT_LE(after, before * (1 + 1e-3) + 1e-9) << "trial " << trial << ", step " << n;
      before = after;
    }
  }
}

TEST(Recovery, ShortensImpulsesThatAddEnergy) {
  // Two balls of 1 kg meet a floor at 1 m/s. The impulses of the second solve throw them back at 2 m/s. A third of it
  // goes, so that the first keeps its energy: 2 N s return it at 1 m/s. The second was not solved again.
  Bodies<3> bodies;
  bodies.add_fixed(Vec3::Zero());
  ConstraintSet<3> constraints;
  std::vector<Contact> contacts;
  for (int ball = 1; ball <= 2; ++ball) bodies.add({.v = -Vec3::UnitZ(), .mass = 1});
  std::vector<Twist<3>> V(3, Twist<3>::Zero());
  for (int ball = 1; ball <= 2; ++ball) {
    contacts.push_back({.i = 0, .j = ball, .n = Vec3::UnitZ(), .gap = -0.1, .r_i = {}, .r_j = {}});
    constraints.rows.push_back(make_row<3>(
        {.i = 0, .j = ball, .Gi = -Vec3::UnitZ(), .Gj = Vec3::UnitZ(), .gap = -0.1, .spook = {}, .lo = 0},
        bodies.motion));
    constraints.rows.back().lambda = 3;
    V[static_cast<std::size_t>(ball)] = 3 * Vec3::UnitZ();
  }
  const std::vector<std::vector<int>> changed = {{0}};
  const WarmStartCache none;
  limit_energy<3>({.constraints = constraints,
                   .V = V,
                   .joints = {},
                   .contacts = contacts,
                   .bodies = bodies,
                   .last = none,
                   .gravity = Vec3::Zero(),
                   .h = 1,
                   .stop = {}},
                  0, changed, nullptr);
  EXPECT_NEAR(constraints.rows[0].lambda, 2, 1e-14);
  EXPECT_NEAR(V[1].z(), 2, 1e-14);
  EXPECT_EQ(constraints.rows[1].lambda, 3);
  EXPECT_EQ(V[2].z(), 3);
}

TEST(Recovery, BrakesASlidingImpactByCoulombsLaw) {
  // Thrown at the floor: friction removes μ times the impulse that stops the fall, and nothing for the overlap.
  const double mu = 0.2, h = 1.0 / 240;
  World<6> world = on_a_floor(mu);
  const int box =
      world.add({.x = Vec3(0, 0, 0.11), .v = Vec3(6, 0, -6), .mass = 1, .half_sides = Vec3(0.5, 0.5, 0.1)});
  world.step(h);
  const double after_a_step = 6;
  for (int n = 0; n < 8; ++n) world.step(h);
  // μ (v_z + g t): that of the fall, and that of the weight since.
  EXPECT_NEAR(world.v(box).x(), after_a_step - mu * (6 + g * 9 * h), 2e-3 * 6 + 2 * mu * g * h);
}

TEST(Recovery, LeavesASpringItsRebound) {
  // With a k of the world or of a body it is a mass on a spring, which returns with the speed that its damping leaves.
  for (const bool of_body : {false, true}) {
    Settings<6> settings;
    if (!of_body) settings.k = 1e3;
    World<6> world(settings);
    const int floor = world.add_plane(Vec3::UnitZ(), 0);
    const int ball = world.add({.x = Vec3(0, 0, 1.5), .mass = 1, .radius = 0.5});
    if (of_body) world.set_material(floor, {.k = 1e3});
    double rebound = 0;
    while (world.time() < 1) {
      world.step(1e-4);
      rebound = std::max(rebound, world.v(ball).z());
    }
    EXPECT_GE(rebound, 0.9 * std::sqrt(2 * g)) << (of_body ? "of the body" : "of the world");
  }
}

TEST(Recovery, HoldsWhatIsJoined) {
  // A dumbbell with one end in the floor comes out, and its other end is not thrown.
  const double h = 1.0 / 60;
  World<6> world = on_a_floor();
  const int low = world.add({.x = Vec3(0, 0, 0.2), .mass = 1, .radius = 0.3});
  const int high = world.add({.x = Vec3(0, 0, 1.2), .mass = 1, .radius = 0.3});
  world.add_joint({.i = low, .j = high, .length = 1});
  for (int n = 0; n < 60; ++n) {
    world.step(h);
    EXPECT_LE(world.v(high).z(), 1e-2 * std::sqrt(g * 0.1) + ignored(h)) << "step " << n;
  }
  EXPECT_NEAR(world.x(low).z(), 0.3, 1e-3);
  EXPECT_NEAR(world.x(high).z(), 1.3, 1e-3);
}

/// A door of 2 m by 1 m by 0.1 m, its hinge at the edge of its long side, `beyond` its upper limit [rad]; with sign -1
/// beyond the lower one.
World<6> door(double beyond, std::optional<double> k_turn = {}, std::optional<Motor> motor = {},
              double sign = 1) {
  World<6> world({.gravity = Vec3::Zero()});
  const int frame = world.add_fixed(Vec3::Zero());
  const Quat q(Eigen::AngleAxisd(sign * (0.5 + beyond), Vec3::UnitZ()));
  const Vec3 arm(0.5, 0, 0);
  const int leaf = world.add(
      {.x = q * arm, .mass = 10, .q = q, .principal = 10.0 / 3 * Vec3(1 + 0.0025, 1 + 0.25, 0.25 + 0.0025)});
  world.add_joint({.i = frame,
                   .j = leaf,
                   .p_j = -arm,
                   .kind = JointKind::hinge,
                   .rest = Quat::Identity(),
                   .k_turn = k_turn,
                   .limits = JointLimits{-0.5, 0.5},
                   .motor = motor});
  return world;
}

TEST(Recovery, TurnsAHingeBackIntoItsRangeWithoutSpeed) {
  for (const double h : steps_to_try)
    for (const double beyond : {1e-3, 0.3, 1.0}) {
      World<6> world = door(beyond);
      // By half a radian a second, then by the share that d sets.
      const double steps = beyond / (0.5 * h) + std::log(1e5) / -std::log(share_left) + 2;
      double last = 0.5 + beyond;
      for (int n = 0; n < steps; ++n) {
        world.step(h);
        const double now = world.joint_position(0);
        EXPECT_LE(now, last + 1e-9) << "h = " << h << ", step " << n;
        EXPECT_GE(now, last - 0.5 * h - 1e-9) << "h = " << h << ", step " << n;
        last = now;
        // A step that turns by φ = h/2 leaves the points r φ²/2 apart. The hinge's rows close this gap with the speed
        // a r φ²/2, where a h = 2.
        const double closing = 0.5 * 0.25 * h;
        EXPECT_LE(kinetic_energy(world.bodies()), 1.001 * 10.0 / 2 * closing * closing)
            << "h = " << h << ", step " << n;
      }
      // The part φ of each closing speed is along the turn, so that beyond/φ steps leave closing/r times `beyond`.
      EXPECT_NEAR(last, 0.5, (1e-5 + 0.25 * h) * beyond) << "h = " << h << ", beyond " << beyond;
    }
}

TEST(Recovery, CountsAsWorkOnlyWhatVelocitiesGoOnWith) {
  for (const double h : steps_to_try) {
    // A plate moves upwards at u, and a box at rest overlaps it: in one step the box gets the speed u, by h F = m u.
    World<6> world({.gravity = Vec3::Zero()});
    const double u = 2, m = 3;
    const int plate = world.add_fixed_box(Vec3(0, 0, -0.1), Vec3(1, 1, 0.1));
    world.set_velocity(plate, u * Vec3::UnitZ());
    const int box = world.add({.x = Vec3(0, 0, 0.15), .mass = m, .half_sides = Vec3::Constant(0.2)});
    world.step(h);
    EXPECT_NEAR(world.v(box).z(), u, 1e-2 * u) << "h = " << h;
    EXPECT_NEAR(world.work_of_drives(), m * u * u, 1e-2 * m * u * u) << "h = " << h;
  }
}

TEST(Recovery, LeavesAMotorAtAnExceededLimitNoSpeed) {
  // The motor presses the door against the limit. The door turns back, and keeps no speed.
  for (const double strength : {50.0, infinity})
    for (const double viscosity : {1e12, infinity})
      for (const double sign : {1.0, -1.0}) {
        World<6> world =
            door(0.3, {}, Motor{.speed = sign, .strength = strength, .viscosity = viscosity}, sign);
        const std::string which = "strength " + short_text(strength) + ", viscosity " + short_text(viscosity);
        const double start = world.joint_position(0);
        for (int n = 0; n < 30; ++n) {
          world.step(1.0 / 60);
          EXPECT_LE(std::abs(world.joint_speed(0)), 1e-3 * 0.5) << which << ", step " << n;
          EXPECT_LE(std::abs(world.work_of_drives()), 1e-2 * 50 * 0.3 / 30) << which << ", step " << n;
        }
        EXPECT_GT(sign * (start - world.joint_position(0)), 0.2) << which;
      }
  // One that returns by itself, more slowly than the limit, keeps its speed.
  World<6> world = door(0.3, {}, Motor{.speed = -0.2, .strength = 50});
  for (int n = 0; n < 20; ++n) {
    world.step(1.0 / 60);
    if (n > 5) {
      EXPECT_NEAR(world.joint_speed(0), -0.2, 1e-2) << "step " << n;
    }
  }
}

TEST(Recovery, ThrowsADoorWhoseLimitIsASpring) {
  World<6> world = door(0.3, 100);
  double fastest = 0;
  for (int n = 0; n < 240; ++n) {
    world.step(1.0 / 240);
    fastest = std::max(fastest, kinetic_energy(world.bodies()));
  }
  EXPECT_GE(fastest, 0.5 * 0.5 * 100 * 0.3 * 0.3);
}

TEST(Recovery, MovesASliderBackIntoItsRangeWithoutSpeed) {
  for (const double h : steps_to_try) {
    World<6> world({.gravity = Vec3::Zero()});
    const int rail = world.add_fixed(Vec3::Zero());
    const int sledge = world.add({.x = Vec3(1.5, 0, 0), .mass = 2, .principal = Vec3::Constant(0.008)});
    world.add_joint({.i = rail,
                     .j = sledge,
                     .kind = JointKind::slider,
                     .axis = Vec3::UnitX(),
                     .rest = Quat::Identity(),
                     .limits = JointLimits{-1, 1}});
    const double start = world.joint_position(0);
    for (int n = 1; n <= 10; ++n) {
      world.step(h);
      EXPECT_NEAR(world.joint_position(0) - 1, (start - 1) * std::pow(share_left, n), 1e-3 * (start - 1));
      EXPECT_LE(world.v(sledge).norm() * h, 1e-3 * (start - 1)) << "step " << n;
    }
  }
}

template <int Dof>
void expect_rope_without_speed(double h) {
  World<Dof> world({.gravity = Vec3::Zero()});
  const int nail = world.add_fixed(Vec3::Zero());
  Body<Dof> body{.x = Vec3(0.6, 0, -0.9), .mass = 2};
  if constexpr (Dof == 6) body.principal = Vec3::Constant(0.008);
  const int bob = world.add(body);
  world.add_joint({.i = nail, .j = bob, .length = 1, .kind = JointKind::rope});
  const double start = body.x.norm() - 1;
  for (int n = 1; n <= 10; ++n) {
    world.step(h);
    EXPECT_NEAR(world.x(bob).norm() - 1, start * std::pow(share_left, n), 1e-3 * start) << "step " << n;
    EXPECT_LE(world.v(bob).norm() * h, 1e-3 * start) << "step " << n;
  }
}

TEST(Recovery, ShortensARopeWithoutSpeed) {
  for (const double h : steps_to_try) {
    expect_rope_without_speed<3>(h);
    expect_rope_without_speed<6>(h);
  }
}

TEST(Recovery, LetsABallSwingOnARopeThatBeganTooLong) {
  // Once the rope has its length, the ball swings by the energy of its height.
  const double h = 1.0 / 1000;
  World<3> world({});
  const int nail = world.add_fixed(Vec3::Zero());
  const int bob = world.add({.x = Vec3(1.2, 0, 0), .mass = 1});
  world.add_joint({.i = nail, .j = bob, .length = 1, .kind = JointKind::rope});
  double fastest = 0;
  while (world.time() < 1) {
    world.step(h);
    fastest = std::max(fastest, world.v(bob).norm());
  }
  EXPECT_NEAR(fastest, std::sqrt(2 * g), 1e-2 * std::sqrt(2 * g));
}

// Recovery leaves no speed, so a gap becomes (1 - a h) of itself: with the default d of joints, -1 of itself for ever.
TEST(Recovery, ClosesTheGapOfAJointThatDoesNotFit) {
  for (const JointKind kind : {JointKind::ball, JointKind::hinge, JointKind::slider, JointKind::weld})
    for (const double off : {1e-2, 1e-3, 1e-4})
      for (const double rate : {60.0, 240.0}) {
        World<6> world({});
        const int nail = world.add_fixed(Vec3(0, 0, 2));
        const int rod = world.add({.x = Vec3(0, 0, 1), .mass = 2, .half_sides = Vec3(0.1, 0.1, 0.5)});
        const int joint = world.add_joint(
            {.i = nail, .j = rod, .p_j = Vec3(0, 0, 1 - off), .kind = kind, .axis = Vec3::UnitY()});
        for (int step = 0; step < 60; ++step) world.step(1 / rate);
        const std::string which = "kind " + std::to_string(static_cast<int>(kind)) + ", off by " +
                                  exact_text(off) + " m, " + exact_text(rate) + " steps a second";
        EXPECT_LE(gap_of(world.joints()[0], world.bodies()).apart.norm(), 1e-8) << which;
        EXPECT_LE((world.joint_force(joint) - Vec3(0, 0, 2 * g)).norm(), 1e-3 * 2 * g) << which;
        // The same after somebody moves it.
        world.place(rod, world.x(rod) + Vec3(0, 0, off), Vec3::Zero());
        for (int step = 0; step < 60; ++step) world.step(1 / rate);
        EXPECT_LE((world.joint_force(joint) - Vec3(0, 0, 2 * g)).norm(), 1e-3 * 2 * g) << which << ", moved";
      }
}

TEST(Recovery, CostsNothingWhereAllRests) {
  int calls = 0;
  Settings<6> settings{.friction = 0.5};
  const Solver<6> inner = settings.solver;
  settings.solver.solve = [&calls, inner](const SolverInput<6>& s) {
    ++calls;
    return inner.solve(s);
  };
  World<6> world(settings);
  world.add_plane(Vec3::UnitZ(), 0);
  for (int n = 0; n < 3; ++n)
    world.add({.x = Vec3(0, 0, 0.5 + n), .mass = 1, .half_sides = Vec3::Constant(0.5)});
  for (int n = 0; n < 60; ++n) world.step(1.0 / 60);
  calls = 0;
  for (int n = 0; n < 60; ++n) world.step(1.0 / 60);
  EXPECT_EQ(calls, 60);
}

}  // namespace
}  // namespace spook::recovery_test
