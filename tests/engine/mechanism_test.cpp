// Hinges, sliders, welds, their limits and motors in a world: constraints, conserved quantities, and outputs.
#include <gtest/gtest.h>

#include <cmath>

#include "checks.hpp"
#include "engine/bodies/conserved_quantities.hpp"
#include "engine/diagnostics/run_check.hpp"
#include "engine/world/world.hpp"
#include "random_input.hpp"
#include "refusals.hpp"
#include "scenes/plane_pendulum.hpp"

namespace spook::mechanism_test {
namespace {

constexpr double epsilon = 2.2e-16;
constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double g = 9.81;
const double pi = std::acos(-1);
const Quat along_y(Eigen::AngleAxisd(-pi / 2, Vec3::UnitX()));  // takes z to y

constexpr std::array guided = {JointKind::hinge, JointKind::slider, JointKind::weld};

/// A body that turns about the world's y axis through the origin.
struct Wheel {
  World<6> world;
  int frame, body, joint;

  explicit Wheel(const Joint& hinge, double moment = 2, const Vec3& x = Vec3::Zero(),
                 const Vec3& gravity = Vec3::Zero())
      : world({.gravity = gravity}),
        frame(world.add_fixed(Vec3::Zero())),
        body(world.add({.x = x, .mass = 3, .principal = Vec3(1, moment, 1.5)})) {
    Joint joint_of = hinge;
    joint_of.i = frame;
    joint_of.j = body;
    joint_of.p_j = -x;
    joint_of.kind = JointKind::hinge;
    joint_of.axis = Vec3::UnitY();
    joint = world.add_joint(joint_of);
  }
};

// Constraints

/// The difference of a box that swings on a hinge from the compound pendulum, after 1.5 s.
double pendulum_error(double h) {
  const double m = 1.5, s = 0.5, angle = 1;
  const Vec3 half(0.1, 0.2, 0.5);
  const double rate2 = m * g * s / (solid_box_moments(m, half).y() + m * s * s);
  const Quat q(Eigen::AngleAxisd(-angle, Vec3::UnitY()));
  World<6> world({.k = 1e10});
  const int frame = world.add_fixed(Vec3(1, 2, 3));
  const int box = world.add({.x = Vec3(1, 2, 3) - q * Vec3(0, 0, s), .mass = m, .q = q, .half_sides = half});
  const int hinge = world.add_joint({.i = frame,
                                     .j = box,
                                     .p_j = Vec3(0, 0, s),
                                     .kind = JointKind::hinge,
                                     .axis = -Vec3::UnitY(),
                                     .rest = Quat::Identity()});
  EXPECT_NEAR(world.joint_position(hinge), angle, 4 * epsilon) << "counted from its rest position";
  world.start_consistently(h);
  const PlanePendulum answer(angle, std::sqrt(rate2));
  double error = 0;
  for (int n = 1; n <= std::lround(1.5 / h); ++n) {
    world.step(h);
    const PlanePendulum::Direction theta = answer.direction(n * h);
    error = std::max(error, std::abs(world.joint_position(hinge) - std::atan2(theta.sin, theta.cos)));
  }
  return error;
}

TEST(Hinge, SwingsABoxAsACompoundPendulum) {
  testing::expect_order("a box on a hinge", "", pendulum_error, 0.01, 3, 2, 0.1);
  EXPECT_LE(pendulum_error(0.001), 1e-5);
}

TEST(Slider, LetsABodyFallAlongItsAxisOnly) {
  // Down a rail of 30 degrees: a = g/2, exactly, leapfrog's n(n + 1)/2 of a h²; the rail carries m g cos 30°.
  const double m = 4, h = 0.01, angle = pi / 6;
  const Vec3 down(std::cos(angle), 0, -std::sin(angle));
  World<6> world({});
  const int frame = world.add_fixed(Vec3::Zero());
  const int body = world.add({.x = Vec3(0.3, 0.2, 0.1), .mass = m, .principal = Vec3(0.1, 0.2, 0.25)});
  const int slider = world.add_joint(
      {.i = frame, .j = body, .p_i = Vec3(0.3, 0.2, 0.1), .kind = JointKind::slider, .axis = down});
  const int steps = 200;
  for (int n = 0; n < steps; ++n) world.step(h);
  const double shift = g / 2 * h * h * steps * (steps + 1) / 2;
  EXPECT_NEAR(world.joint_position(slider), shift, 1e-12 * shift);
  EXPECT_NEAR(world.joint_speed(slider), g / 2 * h * steps, 1e-11);
  EXPECT_NEAR(
      (world.joint_force(slider) - m * g * std::cos(angle) * Vec3(std::sin(angle), 0, std::cos(angle))).norm(),
      0, 1e-9);
  EXPECT_LE(orientation(world, body).angularDistance(Quat::Identity()), 1e-9);
  EXPECT_NEAR(world.joint_torque(slider).norm(), 0, 1e-9) << "the force acts through its centre";
}

TEST(Weld, CarriesAWeightAtALeverArm) {
  // A beam clamped to a wall: the force m g and the torque m g s; it yields by m g/k, and turns by m g s/k_turn.
  const double m = 2, s = 0.7, k = 1e5, k_turn = 3e4, h = 1.0 / 60;
  World<6> world({.k = k});
  const int wall = world.add_fixed(Vec3(0, 0, 1));
  const int beam = world.add({.x = Vec3(s, 0, 1), .mass = m, .half_sides = Vec3(s, 0.05, 0.1)});
  const int weld =
      world.add_joint({.i = wall, .j = beam, .p_j = Vec3(-s, 0, 0), .kind = JointKind::weld, .k_turn = k_turn});
  for (int n = 0; n < 2000; ++n) world.step(h);
  const double tilt = m * g * s / k_turn;  // a chord: twice the sine of half an angle
  EXPECT_NEAR((world.joint_force(weld) - Vec3(0, 0, m * g)).norm(), 0, 1e-9);
  EXPECT_NEAR((world.joint_torque(weld) - Vec3(0, -m * g * s, 0)).norm(), 0, 2 * m * g * s * tilt * tilt)
      << "the lever arm is shorter by the cosine of the tilt";
  const JointGap gap = gap_of(world.joints()[0], world.bodies());
  EXPECT_NEAR((gap.apart - Vec3(0, 0, -m * g / k)).norm(), 0, 1e-12);
  EXPECT_NEAR((gap.turned - Vec3(0, tilt, 0)).norm(), 0, 2 * tilt * tilt * tilt);
}

TEST(Weld, OfTwoBoxesMovesThemAsOne) {
  // Two boxes end to end are a box: in free flight its angular velocity is that of the whole.
  const double h = 0.001;
  const Vec3 half(0.3, 0.1, 0.2), omega(0.5, 3, 0.2);
  World<6> one({.gravity = Vec3::Zero()}), two({.gravity = Vec3::Zero(), .k = 1e6, .d = 0});
  const int whole = one.add({.mass = 4, .omega = omega, .half_sides = Vec3(0.6, 0.1, 0.2)});
  for (const double side : {-0.3, 0.3})
    two.add({.x = Vec3(side, 0, 0),
             .v = omega.cross(Vec3(side, 0, 0)),
             .mass = 2,
             .omega = omega,
             .half_sides = half});
  two.add_joint({.i = 0, .j = 1, .p_i = Vec3(0.3, 0, 0), .p_j = Vec3(-0.3, 0, 0), .kind = JointKind::weld});
  two.start_consistently(h);
  for (int n = 0; n < 1000; ++n) {
    one.step(h);
    two.step(h);
  }
  // Both are of second order in h ω = 3e-3, over 3 rad.
  EXPECT_LE(orientation(two, 0).angularDistance(orientation(one, whole)), 1e-4);
  EXPECT_LE(orientation(two, 0).angularDistance(orientation(two, 1)), 1e-4);
  EXPECT_GT(orientation(one, whole).angularDistance(Quat::Identity()), 1) << "it should tumble";
}

/// Two bodies without shapes that tumble freely, joined beside their centres. The joint's points are apart at first. With
/// a k all motion is that of the rows; without one joints may recover, which changes the angular momentum.
World<6> pair_of_bodies(JointKind kind, testing::Random& random) {
  World<6> world({.gravity = Vec3::Zero(), .k = 1e9, .d = 3});
  for (int n = 0; n < 2; ++n)
    world.add({.x = Vec3(n, 0, 0),
               .v = random.vector(),
               .mass = 1.0 + n,
               .q = random.rotation(),
               .omega = random.vector(),
               .principal = (1.0 + n) / 3 * Vec3(0.0325, 0.1125, 0.1)});
  world.add_joint({.i = 0,
                   .j = 1,
                   .p_i = random.vector(),
                   .p_j = random.vector(),
                   .kind = kind,
                   .axis = random.unit_vector()});
  return world;
}

TEST(FreePair, KeepsMomentumAndAngularMomentum) {
  // Both lever arms of a slider's rows end at j's point. The rows' forces have no net torque, however far the slider is
  // out. Where the points of hinge and weld are apart, (6.15) ensures the same.
  testing::Random random;
  for (const JointKind kind : guided) {
    World<6> world = pair_of_bodies(kind, random);
    const Vec3 p = momentum(world.bodies()), L = angular_momentum(world.bodies());
    const int steps = 2000;
    double reach = 0, fastest = 0;
    for (int n = 0; n < steps; ++n) {
      world.step(0.005);
      for (std::size_t b = 0; b < 2; ++b) {
        reach = std::max(reach, world.bodies().x[b].norm());
        fastest = std::max(fastest, world.bodies().motion.W[b].norm());
      }
    }
    const double roundings = 10 * steps * epsilon * 3 * fastest;
    EXPECT_LE((momentum(world.bodies()) - p).norm(), roundings) << name_of(kind);
    EXPECT_LE((angular_momentum(world.bodies()) - L).norm(), roundings * (1 + reach)) << name_of(kind);
  }
}

TEST(AnySolver, FindsTheSameMotionOfALoop) {
  // Four hinges in a plane: three of their rows are redundant.
  const auto four_bar = [](Solver<6> solver) {
    World<6> world({.solver = std::move(solver), .solver_limits = {.max_sweeps = 20'000, .tolerance = 1e-11}});
    const std::array<Vec3, 4> corners = {Vec3(0, 0, 0), Vec3(0, 0, 1), Vec3(1.5, 0, 1), Vec3(1.5, 0, 0)};
    const int frame = world.add_fixed(corners[0]);
    for (std::size_t n = 0; n < 3; ++n) {
      const Vec3 side = corners[n + 1] - corners[n];
      world.add({.x = (corners[n] + corners[n + 1]) / 2,
                 .mass = 1,
                 .principal = solid_box_moments(1, Vec3::Constant(0.05) + side.cwiseAbs() / 2)});
    }
    for (int n = 0; n < 4; ++n) {
      const int i = n == 0 ? frame : n, j = n == 3 ? frame : n + 1;
      const Vec3 at = corners[static_cast<std::size_t>(n)];
      world.add_joint({.i = i,
                       .j = j,
                       .p_i = at - world.x(i),
                       .p_j = at - world.x(j),
                       .kind = JointKind::hinge,
                       .axis = Vec3::UnitY(),
                       .limits = n == 0 ? std::optional<JointLimits>({-0.5, 0.5}) : std::nullopt,
                       .motor = n == 1 ? std::optional<Motor>({.speed = 1, .strength = 0.2}) : std::nullopt});
    }
    world.apply_central_impulse(1, Vec3(2, 0, 0));
    for (int n = 0; n < 60; ++n) world.step(1.0 / 120);
    EXPECT_LE(world.report().residual, 1e-9);
    return world;
  };
  const World<6> one = four_bar(direct<6>());
  EXPECT_GT(one.joint_position(0), 0.2) << "it should swing";
  for (const Solver<6>& solver : {automatic<6>(), gauss_seidel<6>()}) {
    const World<6> other = four_bar(solver);
    for (int body = 1; body < 4; ++body) EXPECT_NEAR((one.x(body) - other.x(body)).norm(), 0, 1e-6);
  }
}

// Limits

TEST(Limit, HoldsAWeightAtAnAngle) {
  // It comes to rest where the limit's torque equals that of the weight, τ/k_turn beyond it.
  const double s = 0.5, m = 3, k_turn = 1e4, h = 1.0 / 60, limit = 0.3;
  Wheel wheel({.i = 0, .j = 0, .k_turn = k_turn, .limits = JointLimits{-1, limit}}, 2, Vec3(s, 0, 0),
              Vec3(0, 0, -g));
  for (int n = 0; n < 2000; ++n) wheel.world.step(h);
  const double angle = wheel.world.joint_position(wheel.joint), torque = m * g * s * std::cos(angle);
  EXPECT_NEAR(wheel.world.limit_force(wheel.joint), -torque, 1e-9);
  EXPECT_NEAR(angle, limit + torque / k_turn, 1e-12);
  EXPECT_NEAR((wheel.world.joint_torque(wheel.joint) - Vec3(0, -torque, 0)).norm(), 0, 1e-9);
}

TEST(Limit, StopsWhatComesAndGivesItsMomentum) {
  // It arrives at either limit at ω, stays there, and has given I ω; nothing slows it before. It passes the limit by h
  // Σ I ω, 4 I ω/(h k (1 + 4d)) = 1e-8 or less.
  const double I = 2, omega = 1.7, h = 0.01, limit = 1;
  for (const double sign : {1.0, -1.0}) {
    Wheel wheel({.i = 0, .j = 0, .k_turn = 1e10, .limits = JointLimits{-limit, limit}}, I);
    wheel.world.turn(wheel.body, Quat::Identity(), Vec3(0, sign * omega, 0));
    double impulse = 0;
    for (int n = 1; n <= 200; ++n) {
      wheel.world.step(h);
      impulse += h * wheel.world.limit_force(wheel.joint);
      const double free = n * h * omega, angle = sign * wheel.world.joint_position(wheel.joint);
      ASSERT_NEAR(angle, std::min(free, limit), 1e-6) << "step " << n;
    }
    EXPECT_NEAR(impulse, -sign * I * omega, 1e-6);
    EXPECT_NEAR(wheel.world.joint_speed(wheel.joint), 0, 1e-6);
  }
}

TEST(Limit, LetsGo) {
  Wheel wheel({.i = 0, .j = 0, .limits = JointLimits{0, 1}}, 2);
  wheel.world.turn(wheel.body, Quat::Identity(), Vec3(0, 0.5, 0));
  for (int n = 1; n <= 100; ++n) {
    wheel.world.step(0.01);
    ASSERT_EQ(wheel.world.limit_force(wheel.joint), 0) << "step " << n;
  }
  EXPECT_NEAR(wheel.world.joint_position(wheel.joint), 0.5, 1e-12);
}

TEST(Limit, OfASliderStopsAFall) {
  const double h = 0.01, m = 3;
  World<6> world({.k = 1e5});
  const int frame = world.add_fixed(Vec3::Zero());
  const int body = world.add({.mass = m, .principal = Vec3::Ones()});
  const int slider =
      world.add_joint({.i = frame, .j = body, .kind = JointKind::slider, .limits = JointLimits{.lower = -0.5}});
  for (int n = 0; n < 1000; ++n) world.step(h);
  EXPECT_NEAR(world.joint_position(slider), -0.5 - m * g / 1e5, 1e-12);
  EXPECT_NEAR(world.limit_force(slider), m * g, 1e-9);
  EXPECT_NEAR((world.joint_force(slider) - Vec3(0, 0, m * g)).norm(), 0, 1e-9);
}

TEST(Limit, IsPassedByNoMotor) {
  // An arm driven at 1e6 N m rested at 1.5 rad where its limit is 0.5. Both rows close to the limit. The rest is due to
  // the rotation of an arm by a finite angle, where rows are of the first order: 1e-3 is required.
  for (const std::optional<double> k : {std::optional<double>(), std::optional<double>(1e8)})
    for (const double strength : {1e3, 1e6, 1e9, infinity})
      for (const double h : {1.0 / 30, 1.0 / 60, 1.0 / 240, 1.0 / 1000})
        for (const double way : {1.0, -1.0})
          for (const JointKind kind : {JointKind::hinge, JointKind::slider}) {
            World<6> world({.k = k});
            const int frame = world.add_fixed(Vec3::Zero());
            const int arm = world.add({.x = Vec3(1, 0, 0), .mass = 1, .principal = 0.1 * Vec3::Ones()});
            const int joint = world.add_joint({.i = frame,
                                               .j = arm,
                                               .p_j = Vec3(-1, 0, 0),
                                               .kind = kind,
                                               .axis = Vec3::UnitY(),
                                               .limits = JointLimits{.lower = -0.5, .upper = 0.5},
                                               .motor = Motor{.speed = 20 * way, .strength = strength}});
            double most = 0;
            for (int n = 0; n < std::lround(1 / h); ++n) {
              world.step(h);
              most = std::max(most, std::abs(world.joint_position(joint)));
            }
            const auto what = ::testing::Message() << strength << " N m, h = " << h << ", " << name_of(kind)
                                                   << ", k " << (k ? "given" : "by default");
            EXPECT_LT(most, 0.501) << what;
            EXPECT_NEAR(world.joint_position(joint), 0.5 * way, 1e-3) << what;
          }
}

TEST(Limit, CarriesAMotorThatDrivesIntoIt) {
  // A rod of 1 kg hangs sideways on a hinge. At rest at its limit, motor, limit and weight are in balance: the motor has
  // its strength T, and the limit has -(T + m g r cos θ).
  const double h = 1.0 / 120, r = 0.5, angle = 0.3, weight = 9.81 * r * std::cos(angle);
  for (const double sign : {1.0, -1.0})
    for (const double strength : {0.0, 2.0, 5.0, 1e4})
      for (const std::optional<SoftSteps>& soft : {std::optional<SoftSteps>(), std::optional(SoftSteps{})}) {
        World<6> world({.gravity = Vec3(0, 0, -9.81 * sign), .soft_steps = soft});
        const int frame = world.add_fixed(Vec3::Zero());
        const int rod = world.add({.x = Vec3(r, 0, 0), .principal = Vec3(0.01, 1.0 / 12, 1.0 / 12)});
        const JointLimits limits =
            sign > 0 ? JointLimits{.lower = -1, .upper = angle} : JointLimits{.lower = -angle, .upper = 1};
        const int hinge = world.add_joint({.i = frame,
                                           .j = rod,
                                           .p_j = Vec3(-r, 0, 0),
                                           .kind = JointKind::hinge,
                                           .axis = Vec3::UnitY(),
                                           .limits = limits,
                                           .motor = Motor{.speed = sign, .strength = strength}});
        for (int n = 0; n < 480; ++n) world.step(h);
        const auto what = ::testing::Message()
                          << strength << " N m, sign " << sign << (soft ? ", soft steps" : "");
        // The softness of a limit in soft steps turns the arm by some 1e-4 rad under its load.
        const double tolerance = (soft ? 1e-3 : 1e-6) * (strength + weight);
        EXPECT_NEAR(world.motor_force(hinge), sign * strength, tolerance) << what;
        EXPECT_NEAR(world.limit_force(hinge), -sign * (strength + weight), tolerance) << what;
      }
}

TEST(Limit, LeavesAMotorAloneUntilItIsReached) {
  // Eq. (13.17) is the speed itself, bit by bit, while the distance to the limit exceeds that of a step.
  const double h = 1.0 / 60, speed = 2;
  const auto wheel = [&](const JointLimits& limits) {
    return Wheel({.i = 0, .j = 0, .limits = limits, .motor = Motor{.speed = speed, .strength = 7}});
  };
  Wheel near = wheel({.lower = 0, .upper = 1}), far = wheel({.lower = -1000, .upper = 1000});
  while (near.world.joint_position(near.joint) < 1 - 2 * h * speed) {
    for (Wheel* one : {&near, &far}) one->world.step(h);
    ASSERT_EQ(near.world.joint_position(near.joint), far.world.joint_position(far.joint));
    ASSERT_LT(near.world.steps(), 1000);
  }
  EXPECT_NEAR(near.world.joint_speed(near.joint), speed, 1e-6);
}

// Motors

TEST(Motor, BringsAFlywheelToSpeedInIOmegaOverT) {
  const double I = 2, torque = 0.7, omega = 3.1, h = 0.01;
  Wheel wheel({.i = 0, .j = 0, .motor = Motor{.speed = omega, .strength = torque}}, I);
  RunCheck<6> check;
  check.look(wheel.world, h);
  for (int n = 1; n <= 2000; ++n) {
    wheel.world.step(h);
    check.look(wheel.world, h);
    ASSERT_NEAR(wheel.world.joint_speed(wheel.joint), std::min(n * h * torque / I, omega), 1e-9)
        << "step " << n;
    if (n * h < 0.99 * I * omega / torque) {
      ASSERT_NEAR(wheel.world.motor_force(wheel.joint), torque, 1e-9) << "step " << n;
    }
  }
  EXPECT_NEAR(wheel.world.motor_force(wheel.joint), 0, 1e-9) << "nothing brakes it";
  EXPECT_EQ(check.verdict().state, State::sound) << check.verdict().reason;
}

TEST(Motor, OfSomeViscosityLagsByTorqueOverViscosity) {
  // Against a weight on a drum's rim the motor of viscosity c holds w - τ/c.
  const double torque = 3, c = 20, w = 2, h = 0.01;
  World<6> world({.wrench = [&](std::size_t, const Bodies<6>&, double) {
    Twist<6> load = Twist<6>::Zero();
    load[4] = -torque;
    return load;
  }});
  const int frame = world.add_fixed(Vec3::Zero()), drum = world.add({.principal = Vec3(1, 1, 1)});
  const int hinge = world.add_joint({.i = frame,
                                     .j = drum,
                                     .kind = JointKind::hinge,
                                     .axis = Vec3::UnitY(),
                                     .motor = Motor{.speed = w, .viscosity = c}});
  for (int n = 0; n < 1000; ++n) world.step(h);
  EXPECT_NEAR(world.joint_speed(hinge), w - torque / c, 1e-9);
  EXPECT_NEAR(world.motor_force(hinge), torque, 1e-9);
}

TEST(Motor, BetweenTwoBodiesTurnsBoth) {
  // Angular momentum is conserved: I_i ω_i = -I_j ω_j.
  World<6> world({.gravity = Vec3::Zero()});
  const int i = world.add({.principal = Vec3(1, 1, 1)}), j = world.add({.principal = Vec3(3, 3, 3)});
  const int hinge = world.add_joint({.i = i, .j = j, .kind = JointKind::hinge, .motor = Motor{.speed = 4}});
  world.step(0.01);
  EXPECT_NEAR(world.joint_speed(hinge), 4, 1e-9);
  EXPECT_NEAR((angular_velocity(world, i) - Vec3(0, 0, -3)).norm(), 0, 1e-9);
  EXPECT_NEAR((angular_velocity(world, j) - Vec3(0, 0, 1)).norm(), 0, 1e-9);
}

TEST(Motor, CanBeSetAndTakenAway) {
  Wheel wheel({.i = 0, .j = 0}, 2);
  const int rows = wheel.world.joints()[0].rows();
  wheel.world.set_motor(wheel.joint, Motor{.speed = 1});
  EXPECT_EQ(wheel.world.joints()[0].rows(), rows + 1);
  wheel.world.step(0.01);
  EXPECT_NEAR(wheel.world.joint_speed(wheel.joint), 1, 1e-9);
  wheel.world.set_motor(wheel.joint, Motor{.speed = -2});
  wheel.world.step(0.01);
  EXPECT_NEAR(wheel.world.joint_speed(wheel.joint), -2, 1e-9);
  wheel.world.set_motor(wheel.joint, {});
  wheel.world.step(0.01);
  EXPECT_EQ(wheel.world.motor_force(wheel.joint), 0);
  EXPECT_NEAR(wheel.world.joint_speed(wheel.joint), -2, 1e-9);
}

// Angles

TEST(Angle, CountsTurns) {
  for (const double speed : {7.0, -7.0}) {
    Wheel wheel({.i = 0, .j = 0, .motor = Motor{.speed = speed}, .angle = 4 * pi}, 2);
    EXPECT_NEAR(wheel.world.joint_position(wheel.joint), 4 * pi, 1e-12) << "from its given start";
    wheel.world.step(0.01);
    const double before = wheel.world.joint_position(wheel.joint);
    for (int n = 0; n < 2000; ++n) wheel.world.step(0.01);
    EXPECT_NEAR(wheel.world.joint_position(wheel.joint) - before, 20 * speed, 1e-8);
  }
}

TEST(Angle, IsTheTurnOfJRelativeToI) {
  // For any common motion, and any place of the axis.
  testing::Random random;
  const Quat q = random.rotation(), turned = random.rotation();
  const Vec3 axis = random.unit_vector();
  const double angle = 2.5;
  World<6> world({});
  const int i = world.add({.q = q, .principal = Vec3::Ones()});
  const int j = world.add({.q = q * Quat(Eigen::AngleAxisd(angle, axis)) * turned, .principal = Vec3::Ones()});
  const int hinge = world.add_joint({.i = i, .j = j, .kind = JointKind::hinge, .axis = axis, .rest = turned});
  EXPECT_NEAR(world.joint_position(hinge), angle, 1e-12);
  EXPECT_LE(gap_of(world.joints()[0], world.bodies()).turned.norm(), 1e-12);
}

// Refused input

TEST(Input, GuidedJoints) {
  World<3> points({});
  points.add({}), points.add({.x = Vec3(1, 0, 0)});
  for (const JointKind kind : guided)
    expect_refusal({"kind", "point", name_of(kind)}, [&] { points.add_joint({.i = 0, .j = 1, .kind = kind}); });

  World<6> world({});
  world.add({.principal = Vec3::Ones()}), world.add({.principal = Vec3::Ones()});
  const Joint hinge{.i = 0, .j = 1, .kind = JointKind::hinge};
  const auto with = [&](const auto& change) {
    Joint joint = hinge;
    change(joint);
    return joint;
  };
  const auto refuse = [&](const std::vector<std::string>& named, const auto& change) {
    expect_refusal(named, [&] { world.add_joint(with(change)); });
  };
  refuse({"axis", "2"}, [](Joint& joint) { joint.axis = Vec3(0, 0, 2); });
  refuse({"axis", "nan"}, [](Joint& joint) { joint.axis = Vec3(0, 0, nan); });
  refuse({"rest", "2"}, [](Joint& joint) { joint.rest = Quat(2, 0, 0, 0); });
  refuse({"k_turn", "0"}, [](Joint& joint) { joint.k_turn = 0; });
  refuse({"angle", "nan"}, [](Joint& joint) { joint.angle = nan; });
  refuse({"upper", "1", "lower"}, [](Joint& joint) { joint.limits = JointLimits{1, 1}; });
  refuse({"upper", "nan"}, [](Joint& joint) { joint.limits = JointLimits{0, nan}; });
  refuse({"lower", "nan"}, [](Joint& joint) { joint.limits = JointLimits{nan, 1}; });
  refuse({"limit_d", "-1"}, [](Joint& joint) { joint.limits = JointLimits{0, 1}, joint.limit_d = -1; });
  refuse({"speed", "inf"}, [](Joint& joint) { joint.motor = Motor{.speed = infinity}; });
  refuse({"strength", "-1"}, [](Joint& joint) { joint.motor = Motor{.strength = -1}; });
  refuse({"viscosity", "0"}, [](Joint& joint) { joint.motor = Motor{.viscosity = 0}; });
  refuse({"kind", "weld"}, [](Joint& joint) {
    joint.kind = JointKind::weld, joint.limits = JointLimits{0, 1};
  });
  refuse({"kind", "ball"}, [](Joint& joint) { joint.kind = JointKind::ball, joint.motor = Motor{}; });
  refuse({"kind", "distance", "hinge"}, [](Joint& joint) { joint.length = 1; });
  refuse({"kind", "distance"}, [](Joint& joint) { joint.kind = JointKind::distance; });
  EXPECT_TRUE(world.joints().empty()) << "a refused joint must leave no trace";
  const int ball = world.add_joint({.i = 0, .j = 1});
  expect_refusal({"kind", "ball"}, [&] { world.set_motor(ball, Motor{}); });
  expect_refusal({"kind", "ball"}, [&] { world.joint_position(ball); });
  expect_refusal({"joint", "4"}, [&] { world.joint_speed(4); });
}

}  // namespace
}  // namespace spook::mechanism_test
