// Soft steps: several substeps in one search for contacts, each with a soft sweep and a relaxing one, Eq. (10.15) to
// (10.17).
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "engine/bodies/conserved_quantities.hpp"
#include "engine/world/world.hpp"
#include "random_input.hpp"

namespace spook::soft_steps {
namespace {

constexpr double g = 9.81, h = 1.0 / 60;

template <int Dof = 6>
Settings<Dof> soft(double friction = 0.6, SoftSteps steps = {}) {
  Settings<Dof> settings{.friction = friction};
  settings.soft_steps = steps;
  return settings;
}

World<6> on_a_floor(double friction = 0.6, SoftSteps steps = {}) {
  World<6> world(soft(friction, steps));
  world.add_plane(Vec3::UnitZ(), 0);
  return world;
}

Body<6> cube_at(const Vec3& x, double mass = 100) {
  return {.x = x, .mass = mass, .half_sides = Vec3::Constant(0.5)};
}

/// ω of a contact's spring in steps of h [rad/s].
double omega_of_contacts(const SoftSteps& steps = {}) {
  return steps.contacts.turn() * steps.substeps / h;
}

TEST(SoftSpring, IsSpookWithThreeQuartersMoreRelaxation) {
  testing::Random random;
  for (int trial = 0; trial < 100; ++trial) {
    SoftSpring spring{};
    spring.frequency = random.log_uniform(1e-3, 1);
    spring.damping = random.log_uniform(1e-2, 20);
    const double step = random.log_uniform(1e-4, 0.1), S = random.log_uniform(1e-3, 1e3);
    const double omega = spring.turn() / step;
    const SpookParameters spook =
        spook_parameters(step, omega * omega / S, 2 * spring.damping / (step * omega) + 0.75);
    // A dozen operations each.
    EXPECT_NEAR(spring.closed_part(), step * spook.a, 1e-14 * step * spook.a) << testing::Random::seed();
    EXPECT_NEAR(spring.softness() * S, spook.Sigma, 1e-14 * spook.Sigma) << testing::Random::seed();
  }
}

// At rest both sweeps have λ = h m g at the depth m g/k, and k = m ω² for a point mass.
TEST(SoftSteps, RestAtTheDepthThatTheFrequencySays) {
  for (const int substeps : {1, 2, 4, 8}) {
    const SoftSteps steps{.substeps = substeps};
    World<6> world = on_a_floor(0.5, steps);
    const double depth = g / std::pow(omega_of_contacts(steps), 2);
    const int ball = world.add({.x = Vec3(0, 0, 0.5 - depth), .mass = 3, .radius = 0.5});
    for (int n = 0; n < 300; ++n) world.step(h);
    // Each substep closes a tenth or more of the remainder: (1 - h a)^300 is below 1e-15, and a gap is a difference of
    // numbers near 0.5.
    EXPECT_NEAR(world.x(ball).z(), 0.5 - depth, 1e-15) << substeps << " substeps";
    EXPECT_NEAR(world.contact_force(0).z(), 3 * g, 1e-9) << substeps << " substeps";
  }
}

/// The angle of a pendulum of 1 m after `time`, from the horizontal at rest, by Runge-Kutta in steps of 1e-4 s.
double angle_of_pendulum(double time) {
  double angle = std::numbers::pi / 2, rate = 0;
  const auto bend = [](double at) { return -g * std::sin(at); };
  const double dt = 1e-4;
  for (double t = 0; t < time - dt / 2; t += dt) {
    const double k1 = rate, l1 = bend(angle), k2 = rate + dt / 2 * l1, l2 = bend(angle + dt / 2 * k1);
    const double k3 = rate + dt / 2 * l2, l3 = bend(angle + dt / 2 * k2), k4 = rate + dt * l3,
                 l4 = bend(angle + dt * k3);
    angle += dt / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
    rate += dt / 6 * (l1 + 2 * l2 + 2 * l3 + l4);
  }
  return angle;
}

TEST(SoftSteps, SwingAPendulumWithAnErrorOfFirstOrder) {
  std::vector<double> errors;
  for (const int substeps : {4, 8, 16, 32}) {
    World<3> world(soft<3>(0, {.substeps = substeps}));
    const int top = world.add_fixed(Vec3::Zero()), ball = world.add({.x = Vec3(1, 0, 0), .mass = 2});
    world.add_joint({.i = top, .j = ball, .length = 1});
    world.start_half_step_back(h);
    for (int n = 0; n < 60; ++n) world.step(h);
    const Vec3 x = world.x(ball);
    errors.push_back(std::abs(std::atan2(x.x(), -x.z()) - angle_of_pendulum(1)));
    EXPECT_NEAR(x.norm(), 1, 0.1 / substeps) << substeps << " substeps";
  }
  EXPECT_LE(errors[0], 0.05);
  // The next order is left out of this rate: 1.5 in place of 2.
  for (std::size_t n = 1; n < errors.size(); ++n) EXPECT_LE(errors[n], errors[n - 1] / 1.5) << n;
}

// A joint with a k of its own is a spring, which both sweeps leave unchanged.
TEST(SoftSteps, HangAWeightOnASpring) {
  const double k = 200, mass = 3;
  World<3> world(soft<3>());
  const int top = world.add_fixed(Vec3::Zero()), weight = world.add({.x = Vec3(0, 0, -1), .mass = mass});
  world.add_joint({.i = top, .j = weight, .length = 1, .k = k, .d = 10});
  for (int n = 0; n < 1200; ++n) world.step(h);
  EXPECT_NEAR(-world.x(weight).z(), 1 + mass * g / k, 1e-6);
}

// A contact of a cube has S = (1 + 6 (1/4 + 1/4))/m at each cube's corner, and four corners carry the weight above. So
// a cube yields by g/ω² on the floor, and by 2 g/ω² on another, times the number of cubes above it.
TEST(SoftSteps, LetATowerOfTwentyStandWhereItsSpringsSay) {
  World<6> world = on_a_floor();
  const int n = 20;
  int top = 0;
  for (int level = 0; level < n; ++level) top = world.add(cube_at(Vec3(0, 0, level + 0.5)));
  const double sink = (n + 2 * n * (n - 1) / 2) * g / std::pow(omega_of_contacts(), 2);
  double half_way = 0;
  for (int step = 0; step < 1000; ++step) {
    world.step(h);
    if (step == 500) half_way = world.x(top).z();
  }
  // A tower that leans by an angle has more than half of the weight on two corners, to second order in it.
  EXPECT_NEAR(world.x(top).z(), n - 0.5 - sink, 0.02 * sink);
  EXPECT_NEAR(world.x(top).z(), half_way, 0.01 * sink);
  EXPECT_LE(world.x(top).head<2>().norm(), 0.05);
}

TEST(SoftSteps, LetAPyramidStandForAThousandSteps) {
  World<6> world = on_a_floor();
  std::vector<int> cubes;
  for (int level = 0; level < 10; ++level)
    for (int n = 0; n < 10 - level; ++n)
      cubes.push_back(world.add(cube_at(Vec3(n + level / 2.0, 0, level + 0.5))));
  std::vector<Vec3> half_way;
  const std::vector<Vec3> before = world.bodies().x;
  for (int step = 0; step < 1000; ++step) {
    world.step(h);
    if (step == 500) half_way = world.bodies().x;
  }
  // At most as much as a tower of ten: 100 g/ω².
  const double sink = 100 * g / std::pow(omega_of_contacts(), 2);
  for (const int cube : cubes) {
    EXPECT_LE((world.x(cube) - before[world.index(cube)]).norm(), sink) << cube;
    EXPECT_LE((world.x(cube) - half_way[world.index(cube)]).norm(), 0.01 * sink) << cube;
  }
  EXPECT_LE(kinetic_energy(world.bodies()), 1e-3 * 100 * g * sink * 55);
}

// Ten warm-started sweeps a step, without relaxation, give this grid thirty times its energy in half a second.
TEST(SoftSteps, HoldAGridOfBallJoints) {
  for (const int substeps : {2, 3, 4}) {
    World<6> world(soft(0, {.substeps = substeps}));
    const int side = 40;
    std::vector<int> at;
    for (int z = 0; z < side; ++z)
      for (int x = 0; x < side; ++x) {
        const Vec3 place(x, 0, -z);
        at.push_back(
            z == 0 ? world.add_fixed(place)
                   : world.add({.x = place, .v = Vec3(0, 1, 0), .mass = 1, .principal = Vec3::Constant(0.1)}));
      }
    const auto join = [&](int i, int j, const Vec3& half) {
      world.add_joint({.i = at[i], .j = at[j], .p_i = half, .p_j = -half});
    };
    for (int z = 0; z < side; ++z)
      for (int x = 0; x < side; ++x) {
        const int n = side * z + x;
        if (z > 0 && x + 1 < side) join(n, n + 1, Vec3(0.5, 0, 0));
        if (z + 1 < side) join(n, n + side, Vec3(0, 0, -0.5));
      }
    const auto energy = [&] {
      double sum = kinetic_energy(world.bodies());
      for (const int body : at)
        if (!world.bodies().is_fixed(world.index(body))) sum += g * world.x(body).z();
      return sum;
    };
    const double given = energy(), T = kinetic_energy(world.bodies());
    for (int n = 0; n < 60; ++n) world.step(h);
    double apart = 0;
    for (const Joint& joint : world.joints())
      apart = std::max(apart, gap_of(joint, world.bodies()).apart.norm());
    // Eq. (10.18): 39 bodies hang from the joints at the top. S is 1/m at a static body's neighbour and 2/m below; a
    // quarter more while they swing.
    const double omega = SoftSteps{}.joints.turn() * substeps / h;
    EXPECT_LE(apart, 1.25 * 2 * 39 * g / (omega * omega)) << substeps << " substeps";
    EXPECT_LE(energy(), given + 0.01 * T) << substeps << " substeps";
  }
}

TEST(SoftSteps, KeepMomentumWhereBodiesBeginInEachOther) {
  testing::Random random;
  Settings<6> settings = soft(0.5);
  settings.gravity = Vec3::Zero();
  World<6> world(settings);
  for (int n = 0; n < 12; ++n) {
    Body<6> body{.mass = 1};
    body.x = random.vector(0.7);
    body.v = random.vector(1);
    body.mass = random.log_uniform(0.1, 10);
    if (n % 2 == 0)
      body.half_sides = Vec3::Constant(0.3);
    else
      body.radius = 0.3;
    world.add(body);
  }
  const auto momentum = [&] {
    Vec3 sum = Vec3::Zero();
    for (int n = 0; n < 12; ++n) sum += world.bodies().mass[world.index(n)] * world.v(n);
    return sum;
  };
  const Vec3 before = momentum();
  const double T = kinetic_energy(world.bodies());
  for (int n = 0; n < 100; ++n) world.step(h);
  // Each of some 1e5 updates adds and subtracts the same impulse, of 10 N s at most.
  EXPECT_LE((momentum() - before).norm(), 1e5 * 1e-15) << testing::Random::seed();
  // One relaxing sweep leaves a part of the closing speed, which is at most 3 m/s.
  double closing = 0;
  for (const double mass : world.bodies().mass) closing += mass * 9 / 2;
  EXPECT_LE(kinetic_energy(world.bodies()), T + closing) << testing::Random::seed();
}

TEST(SoftSteps, MoveAnOverlapApartWithoutSpeed) {
  for (const double depth : {1e-3, 0.05, 0.2, 0.45}) {
    World<6> world = on_a_floor();
    const int cube = world.add(cube_at(Vec3(0, 0, 0.5 - depth)));
    double highest = 0;
    for (int n = 0; n < 120; ++n) {
      world.step(h);
      highest = std::max(highest, world.x(cube).z());
    }
    // One sweep of four rows leaves some of the closing speed, 3 m/s at most, for one substep.
    EXPECT_LE(highest, 0.5 + 3 * h / 4) << "depth " << depth;
    EXPECT_NEAR(world.x(cube).z(), 0.5 - g / std::pow(omega_of_contacts(), 2), 1e-5) << "depth " << depth;
    EXPECT_LE(world.v(cube).norm(), 1e-6) << "depth " << depth;
  }
}

// The ball stops on the floor within the step of the impact, and leaves at its end with -e times its speed at the begin
// of the step. Its height then was at most u h, and its velocity belongs to half a substep before: together at most 2 u
// h.
TEST(SoftSteps, BounceToESquaredOfTheHeight) {
  for (const double e : {0.0, 0.5, 1.0})
    for (const double step : {1.0 / 60, 1.0 / 240, 1.0 / 960}) {
      Settings<6> settings = soft(0);
      settings.impacts = ImpactLaw{.restitution = e, .friction = 0};
      World<6> world(settings);
      world.add_plane(Vec3::UnitZ(), 0);
      const int ball = world.add({.x = Vec3(0, 0, 1.1), .mass = 2, .radius = 0.1});
      double highest = 0;
      bool hit = false;
      while (world.time() < 1.2) {
        world.step(step);
        hit = hit || world.x(ball).z() < 0.12;
        if (hit) highest = std::max(highest, world.x(ball).z() - 0.1);
      }
      const double u = std::sqrt(2 * g);
      EXPECT_NEAR(highest, e * e, 2 * u * step + 0.02) << "e = " << e << ", step " << step;
    }
}

/// A sledge of 1 kg under a box of 20 kg, both at rest, is pulled along the floor by a force for a second. Returns the
/// distances of both.
std::pair<double, double> pulled(double force, double direction, double mu) {
  Settings<6> settings = soft(mu);
  const Vec3 along(std::cos(direction), std::sin(direction), 0);
  settings.wrench = [=](std::size_t i, const Bodies<6>&, double time) {
    Twist<6> pull = Twist<6>::Zero();
    if (i == 1 && time > 0.5) pull.head<3>() = force * along;
    return pull;
  };
  World<6> world(settings);
  world.add_plane(Vec3::UnitZ(), 0);
  const int sledge = world.add({.x = Vec3(0, 0, 0.1), .mass = 1, .half_sides = Vec3(0.5, 0.5, 0.1)});
  const int load = world.add({.x = Vec3(0, 0, 0.5), .mass = 20, .half_sides = Vec3(0.4, 0.4, 0.3)});
  while (world.time() < 1.5) world.step(h);
  return {world.x(sledge).dot(along), world.x(load).dot(along)};
}

TEST(SoftSteps, HoldASledgeUnderALoadInsideTheCone) {
  testing::Random random;
  const double mu = 0.3, weight = 21 * g;
  for (int trial = 0; trial < 5; ++trial) {
    const double direction = random.uniform(0, 2 * std::numbers::pi);
    const auto [held, its_load] = pulled(0.9 * mu * weight, direction, mu);
    // The force of friction needs some sweeps to build up, in which the sledge is free for a substep or two. By then it
    // has moved by at most F/m h², with h of a step.
    const double free = 0.9 * mu * weight / 1 * h * h;
    EXPECT_LE(std::abs(held), free) << testing::Random::seed();
    EXPECT_LE(std::abs(its_load), free) << testing::Random::seed();
    // Both accelerate by 0.2 μ g. A step more or less at the start is 2/60 of the way.
    const double way = 0.2 * mu * g / 2;
    const auto [slid, with_it] = pulled(1.2 * mu * weight, direction, mu);
    EXPECT_NEAR(slid, way, 2 * h * way + free) << testing::Random::seed();
    EXPECT_NEAR(with_it, way, 2 * h * way + free) << testing::Random::seed();
  }
}

TEST(SoftSteps, StopAtALimitAndRunAMotor) {
  World<6> world(soft(0));
  const int frame = world.add_fixed(Vec3::Zero());
  const int arm = world.add({.x = Vec3(0.5, 0, 0), .mass = 1, .principal = Vec3::Constant(0.02)});
  const int wheel = world.add({.x = Vec3(5, 0, 0), .mass = 1, .principal = Vec3::Constant(0.02)});
  // A turn about y lowers the arm; the limit stops it at half a radian.
  const int hinge = world.add_joint({.i = frame,
                                     .j = arm,
                                     .p_j = Vec3(-0.5, 0, 0),
                                     .kind = JointKind::hinge,
                                     .axis = Vec3::UnitY(),
                                     .limits = JointLimits{.lower = -1, .upper = 0.5}});
  const int drive = world.add_joint({.i = frame,
                                     .j = wheel,
                                     .p_i = Vec3(5, 0, 0),
                                     .kind = JointKind::hinge,
                                     .axis = Vec3::UnitY(),
                                     .motor = Motor{.speed = 3, .strength = 0.06}});
  double farthest = 0;
  for (int n = 0; n < 240; ++n) {
    world.step(h);
    farthest = std::max(farthest, world.joint_position(hinge));
    // Torque over inertia: 3 rad/s².
    EXPECT_NEAR(world.joint_speed(drive), std::min(3.0, 3 * (n + 1) * h), 1e-3);
  }
  // Eq. (10.18): the torque of the weight, times the row's S, which is that of the arm about its centre, over ω².
  const SoftSteps steps;
  const double omega = steps.joints.turn() * steps.substeps / h;
  const double turned = g * 0.5 * std::cos(0.5) / 0.02 / (omega * omega);
  EXPECT_NEAR(world.joint_position(hinge), 0.5 + turned, 0.02 * turned);
  // The arm arrives with √(2 m g s/I) or 4 rad/s, and a sweep of the limit's row changes its speed by S λ for its own
  // inertia, a tenth of that about the hinge: it may take a substep's way to stop.
  EXPECT_LE(farthest, 0.5 + turned + 4 * h / 4);
  EXPECT_NEAR(world.joint_speed(drive), 3, 1e-6);
}

TEST(SoftSteps, FollowABelt) {
  World<6> world = on_a_floor(0.5);
  const int cube = world.add(cube_at(Vec3(0, 0, 0.5)));
  world.set_surface_velocity(0, Vec3(1, 0, 0));
  for (int n = 0; n < 60; ++n) world.step(h);
  // It slides for v/(μ g), and then moves with the belt.
  EXPECT_NEAR(world.v(cube).x(), 1, 1e-3);
  EXPECT_NEAR(world.x(cube).x(), 1 - 1 / (2 * 0.5 * g), 0.02);
}

TEST(SoftSteps, CostTwoUpdatesOfEachRowInASubstepAndOneSearchInAStep) {
  for (const int substeps : {1, 4, 7}) {
    World<6> world = on_a_floor(0.6, {.substeps = substeps});
    for (int n = 0; n < 3; ++n) world.add(cube_at(Vec3(0, 0, n + 0.5)));
    world.time_stages();
    for (int n = 1; n <= 20; ++n) {
      const std::int64_t before = world.row_updates();
      world.step(h);
      EXPECT_EQ(world.row_updates() - before, 2 * substeps * std::ssize(world.rows()));
      EXPECT_EQ(world.stage_times().runs[static_cast<std::size_t>(Stage::contacts)], n);
    }
  }
}

TEST(SoftSteps, AreAStepOfTheSameTimeWithoutRows) {
  World<6> world(soft());
  const int body = world.add({.v = Vec3(1, 2, 3), .mass = 1, .radius = 0.1});
  world.start_half_step_back(h);
  for (int n = 0; n < 60; ++n) world.step(h);
  EXPECT_NEAR(world.time(), 1, 1e-12);
  EXPECT_NEAR((world.x(body) - Vec3(1, 2, 3 - g / 2)).norm(), 0, 1e-12);
}

TEST(SoftSteps, RefuseWhatTheyDoNotUse) {
  const auto refused = [](const std::string& name, Settings<6> settings) {
    settings.soft_steps = settings.soft_steps.value_or(SoftSteps{});
    try {
      World<6> world(settings);
      ADD_FAILURE() << name << " was taken";
    } catch (const std::invalid_argument& error) {
      EXPECT_NE(std::string(error.what()).find(name), std::string::npos) << error.what();
    }
  };
  refused("k must be left out", {.k = 1e6});
  refused("d must be left out", {.d = 1});
  refused("integrator_order must be 2", {.integrator_order = 4});
  refused("substeps must be from 1 to 1024", {.soft_steps = SoftSteps{.substeps = 0}});
  refused("closing_speed must be positive", {.soft_steps = SoftSteps{.closing_speed = -1}});
  for (const double bad : {0.0, -1.0, std::nan(""), infinity}) {
    refused("contacts' frequency", {.soft_steps = SoftSteps{.contacts = {.frequency = bad, .damping = 1}}});
    refused("joints' damping", {.soft_steps = SoftSteps{.joints = {.frequency = 0.1, .damping = bad}}});
  }
  World<6> world = on_a_floor();
  EXPECT_THROW(world.set_material(0, {.k = 1e6}), std::invalid_argument);
  EXPECT_THROW(world.set_material(0, {.d = 3}), std::invalid_argument);

  const int ball = world.add({.x = Vec3(0, 0, 5), .mass = 1, .radius = 0.1}),
            joints = static_cast<int>(world.joints().size());
  EXPECT_THROW(world.add_joint({.i = 0, .j = ball, .length = 1, .kind = JointKind::rope}),
               std::invalid_argument);
  EXPECT_THROW(world.add_joint({.i = 0, .j = ball, .kind = JointKind::hinge, .spring = Spring{.stiffness = 1}}),
               std::invalid_argument);
  const int hinge = world.add_joint({.i = 0, .j = ball, .kind = JointKind::hinge});
  EXPECT_THROW(world.set_spring(hinge, Spring{.stiffness = 1}), std::invalid_argument);
  EXPECT_EQ(static_cast<int>(world.joints().size()), joints + 1);
}

}  // namespace
}  // namespace spook::soft_steps
