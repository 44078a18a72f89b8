// Distances and ball joints in a world: constraints, conserved quantities, and refused input.
#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

#include "algebra.hpp"
#include "checks.hpp"
#include "engine/bodies/conserved_quantities.hpp"
#include "engine/world/world.hpp"
#include "refusals.hpp"
#include "scenes/plane_pendulum.hpp"
#include "scenes/registry.hpp"
#include "scenes/run.hpp"

namespace spook::joint_test {
namespace {

constexpr double epsilon = 2.2e-16;
constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double g = 9.81;
const StopRule patient = {.max_sweeps = 100'000, .tolerance = 1e-13};

Vec3 impulse_of_ball_joint(const World<6>& world, int joint) {
  return {world.joint_lambda(joint, 0), world.joint_lambda(joint, 1), world.joint_lambda(joint, 2)};
}

// Conserved quantities

TEST(FreeChain, OfPointsKeepsMomentumAndAngularMomentum) {
  World<3> world({.gravity = Vec3::Zero(), .k = 1e6, .d = 3});
  double momenta = 0;  // Σ |p|, the scale of round-off
  for (int i = 0; i < 6; ++i) {
    const double mass = 0.3 * (i + 1);
    const Vec3 v(std::sin(3.0 * i), std::cos(5.0 * i), std::sin(7.0 * i + 1));
    world.add({.x = Vec3(0.5 * i, 0.1 * (i % 2), 0), .v = v, .mass = mass});
    if (i > 0) world.add_joint({.i = i - 1, .j = i, .length = (world.x(i) - world.x(i - 1)).norm()});
    momenta += mass * v.norm();
  }
  const Vec3 p = momentum(world.bodies()), L = angular_momentum(world.bodies());
  const Vec3 first = world.v(0);
  const int steps = 10'000;
  for (int step = 0; step < steps; ++step) world.step(0.005);
  EXPECT_GT((world.v(0) - first).norm(), 0.1) << "the rods should pull";
  double reach = 0;
  for (const Vec3& x : world.bodies().x) reach = std::max(reach, x.norm());
  // Each impulse acts along the line of centres at x_n, the same line for both. The error is a few units of round-off a
  // step.
  EXPECT_LE((momentum(world.bodies()) - p).norm(), 10 * steps * epsilon * momenta);
  EXPECT_LE((angular_momentum(world.bodies()) - L).norm(), 10 * steps * epsilon * momenta * reach);
}

/// Boxes end to end, tumbling freely.
World<6> necklace(int count, double k) {
  World<6> world({.gravity = Vec3::Zero(), .k = k, .d = 3});
  const Vec3 half(0.3, 0.1, 0.15);
  for (int i = 0; i < count; ++i)
    world.add({.x = Vec3(0.6 * i - 0.3 * (count - 1), 0, 0),
               .v = Vec3(0, 0.2 * std::sin(2.0 * i), 0.2 * std::cos(3.0 * i)),
               .mass = 1 + 0.5 * i,
               .omega = Vec3(0.4 * i, -0.7, 0.5),
               .principal = solid_box_moments(1 + 0.5 * i, half)});
  for (int i = 1; i < count; ++i)
    world.add_joint({.i = i - 1, .j = i, .p_i = half.x() * Vec3::UnitX(), .p_j = -half.x() * Vec3::UnitX()});
  return world;
}

/// The present gap of a ball joint of a necklace.
Vec3 gap(const World<6>& world, int joint) {
  const Joint& ball = world.joints()[static_cast<std::size_t>(joint)];
  return world.x(ball.j) + orientation(world, ball.j) * ball.p_j - world.x(ball.i) -
         orientation(world, ball.i) * ball.p_i;
}

TEST(FreeChain, OfBodiesKeepsMomentumAndAngularMomentum) {
  // J and -J at one point between i's and j's: no torque, however far apart the two are.
  World<6> world = necklace(4, 1e6);
  const Vec3 p = momentum(world.bodies());
  const Vec3 L = angular_momentum(world.bodies());
  const int steps = 10'000;
  Vec3 beside = Vec3::Zero();
  double reach = 0, most_beside = 0;
  for (int step = 0; step < steps; ++step) {
    std::vector<Vec3> gaps;
    for (int joint = 0; joint < 3; ++joint) gaps.push_back(gap(world, joint));
    world.step(0.005);
    for (int joint = 0; joint < 3; ++joint)
      beside += gaps[static_cast<std::size_t>(joint)].cross(impulse_of_ball_joint(world, joint));
    most_beside = std::max(most_beside, beside.norm());
    for (const Vec3& x : world.bodies().x) reach = std::max(reach, x.norm());
  }
  const double momenta = 10;  // at least Σ |p|, and Σ |I ω| over a metre
  EXPECT_LE((momentum(world.bodies()) - p).norm(), 10 * steps * epsilon * momenta);
  const double roundings = 10 * steps * epsilon * momenta * (1 + reach);
  EXPECT_GT(most_beside, 100 * roundings) << "J at one point and -J at the other would turn it visibly";
  EXPECT_LE((angular_momentum(world.bodies()) - L).norm(), roundings);
}

/// The fraction of m g l that a rod of 1 m, released from the horizontal, has lost after 10 s.
double lost_by_a_rod(double h, std::optional<double> d) {
  World<3> world({.d = d, .solver = direct<3>()});
  world.add_fixed(Vec3::Zero());
  world.add({.x = Vec3(1, 0, 0)});
  world.add_joint({.i = 0, .j = 1, .length = 1, .k = 1e9});
  world.start_consistently(h);
  // T is half a step earlier than x.
  const auto energy = [&] {
    return kinetic_energy(world.bodies()) + g * (world.x(1) - h / 2 * world.v(1)).z();
  };
  const double before = energy();
  for (int step = 0; step < std::lround(10 / h); ++step) world.step(h);
  return (before - energy()) / g;
}

TEST(Relaxation, OfARodCostsWhatTheLessonSays) {
  // The digits of the table in chapter 06.
  EXPECT_NEAR(lost_by_a_rod(1.0 / 60, 0.25), 0.0012, 5e-5);
  EXPECT_NEAR(lost_by_a_rod(1.0 / 60, 1), 0.0081, 5e-5);
  EXPECT_NEAR(lost_by_a_rod(1.0 / 60, 3), 0.048, 5e-4);
  EXPECT_NEAR(lost_by_a_rod(1.0 / 60, 10), 0.24, 5e-3);
  EXPECT_NEAR(lost_by_a_rod(1.0 / 240, 0.25), 0.00006, 5e-6);
  EXPECT_NEAR(lost_by_a_rod(1.0 / 240, 1), 0.0003, 5e-5);
  EXPECT_NEAR(lost_by_a_rod(1.0 / 240, 3), 0.0014, 5e-5);
  EXPECT_NEAR(lost_by_a_rod(1.0 / 240, 10), 0.009, 5e-4);
  EXPECT_EQ(lost_by_a_rod(1.0 / 60, {}), lost_by_a_rod(1.0 / 60, 0.25)) << "the default of joints";
}

TEST(Whirl, HasTheGapAndTensionOfTheDiscreteCircle) {
  // x_n = R (cos nα, sin nα). So v_{n±1/2} has the size w = 2R sin(α/2)/h, and ∓w sin(α/2) of it along the rod at x_n.
  // Hence λ = -2 m w sin(α/2), and (1/m + Σ) λ = -a gap - b w sin(α/2) determines the gap.
  const double m = 2.5, R = 0.8, alpha = 0.05, k = 1e5;
  for (const double h : {0.001, 1.0 / 60})
    for (const double d : {0.25, 1.0, 3.0, 10.0}) {
      const double s = std::sin(alpha / 2), w = 2 * R * s / h;
      const SpookParameters spook = spook_parameters(h, k, d);
      const double gap = w * s * (2 - spook.b + 2 * m * spook.Sigma) / spook.a;
      World<3> world({.gravity = Vec3::Zero(), .k = k, .d = d});
      const int centre = world.add_fixed(Vec3::Zero());
      const int body = world.add({.x = Vec3(R, 0, 0), .v = w * Vec3(s, std::cos(alpha / 2), 0), .mass = m});
      world.add_joint({.i = centre, .j = body, .length = R - gap});
      const int steps = 300;
      for (int n = 1; n <= steps; ++n) {
        world.step(h);
        const Vec3 answer = R * Vec3(std::cos(n * alpha), std::sin(n * alpha), 0);
        // Round-off of the angle adds up, and that of the speed adds up in the angle.
        ASSERT_NEAR((world.x(body) - answer).norm(), 0, (10 + n) * n * epsilon * R)
            << "h " << h << ", d " << d << ", step " << n;
      }
      EXPECT_NEAR(-world.joint_lambda(0) / h, m * w * w / R, steps * 100 * epsilon * m * w * w / R);
      // Without Σ it is (1 + 2d) R sin²(α/2): (1 + 2d) h² A/4 for small α, A = v²/R.
      EXPECT_NEAR(gap - m * w * w / (R * k), (1 + 2 * d) * R * s * s, 1e-12);
    }
}

// Constraints

TEST(Wire, HasTheTensionsOfTheLoadAndStretchesByTOverK) {
  // Eq. (6.8) and (6.9), for any h and d. N links, m each and M the last.
  const int N = 4;
  const double m = 0.5, M = 3, k = 1e5;
  for (const double h : {1.0 / 30, 1.0 / 60, 1.0 / 240})
    for (const double d : {0.5, 1.0, 3.0, 10.0}) {
      World<3> world({.k = k, .d = d, .solver_limits = patient});
      world.add_fixed(Vec3::Zero());
      for (int i = 1; i <= N; ++i) {
        world.add({.x = Vec3(0, 0, -i), .mass = i == N ? M : m});
        world.add_joint({.i = i - 1, .j = i, .length = 1});
      }
      for (int step = 0; step < 3000; ++step) world.step(h);
      for (int i = 1; i <= N; ++i) {
        const double T = (M + (N - i) * m) * g;
        const std::string which =
            "link " + std::to_string(i) + ", h " + std::to_string(h) + ", d " + std::to_string(d);
        // The solver's last sweep changed a velocity by 1e-13 at most. Its slowest part, of a rate of 1 - ρ > 1/100, is
        // off by a hundred times that: in the gap over a, and in T times the stiffness.
        const double slack = 1e-11 / spook_parameters(h, k, d).a + 16 * epsilon * N;
        EXPECT_NEAR((world.x(i) - world.x(i - 1)).norm() - 1, T / k, slack) << which;
        EXPECT_NEAR(-world.joint_lambda(i - 1) / h, T, k * slack) << which;
      }
    }
}

TEST(Wire, OfTwoBodiesFollowsTheSolutionOfTwoEquations) {
  // The same step by hand, in one dimension: z downwards, S λ = B solved exactly.
  const double m1 = 0.7, m2 = 4, h = 1.0 / 60, k = 2e4, d1 = 2, d2 = 4;
  World<3> world({.k = k, .d = d1, .solver_limits = patient});
  world.add_fixed(Vec3::Zero());
  world.add({.x = Vec3(0, 0, -1), .mass = m1});
  world.add({.x = Vec3(0, 0, -2.1), .v = Vec3(0, 0, -0.3), .mass = m2});
  world.add_joint({.i = 0, .j = 1, .length = 1});
  world.add_joint({.i = 1, .j = 2, .length = 1, .d = d2});

  const SpookParameters s1 = spook_parameters(h, k, d1), s2 = spook_parameters(h, k, d2);
  Eigen::Matrix2d S;
  S << 1 / m1 + s1.Sigma, -1 / m1, -1 / m1, 1 / m1 + 1 / m2 + s2.Sigma;
  Eigen::Vector2d z(1, 2.1), v(0, 0.3);
  for (int step = 1; step <= 300; ++step) {
    const Eigen::Vector2d B(-s1.a * (z[0] - 1) - s1.b * v[0] - h * g,
                            -s2.a * (z[1] - z[0] - 1) - s2.b * (v[1] - v[0]));
    const Eigen::Vector2d lambda = S.inverse() * B;
    v += Eigen::Vector2d(h * g + (lambda[0] - lambda[1]) / m1, h * g + lambda[1] / m2);
    z += h * v;
    world.step(h);
    // Every step's solve is right to about 1e-13/(1 - ρ), and the relaxation damps old errors.
    ASSERT_NEAR(world.x(1).z(), -z[0], 1e-11) << "step " << step;
    ASSERT_NEAR(world.x(2).z(), -z[1], 1e-11) << "step " << step;
    ASSERT_NEAR(world.joint_lambda(0), lambda[0], 1e-10);
    ASSERT_NEAR(world.joint_lambda(1), lambda[1], 1e-10);
  }
}

/// Sweeps of one step of a wire at rest from λ = 0, until a sweep changes less than the tolerance.
int sweeps_of_wire(int N, double ratio, double tolerance, bool top_down) {
  World<3> world({.k = 1e14,
                  .solver = gauss_seidel<3>(),
                  .solver_limits = {.max_sweeps = 1'000'000, .tolerance = tolerance}});
  world.add_fixed(Vec3::Zero());
  for (int i = 1; i <= N; ++i) world.add({.x = Vec3(0, 0, -i), .mass = i == N ? ratio : 1});
  for (int n = 1; n <= N; ++n) {
    const int i = top_down ? n : N + 1 - n;
    world.add_joint({.i = i - 1, .j = i, .length = 1});
  }
  world.step(1.0 / 60);
  return world.report().iterations;
}

/// The factor of the slowest part of the error a sweep: the largest eigenvalue of Gauss-Seidel's matrix.
double rate_of_wire(int N, double ratio) {
  Eigen::MatrixXd S = Eigen::MatrixXd::Zero(N, N);
  for (int i = 0; i < N; ++i) {
    const double above = i == 0 ? 0 : 1, below = i == N - 1 ? 1 / ratio : 1;  // inverse masses
    S(i, i) = above + below;
    if (i > 0) S(i, i - 1) = S(i - 1, i) = -1;
  }
  return testing::spectral_radius(testing::sweep_matrix(S));
}

TEST(Wire, NeedsTheSweepsOfTheTheory) {
  struct Case {
    int N;
    double ratio;
    double sweeps_per_e;  ///< Eq. (6.12): 4N²/π², or (N-1) M/m
    double off;           ///< its error: 1/N² for the first, N m/M for the second
  };
  for (const Case& c : {Case{10, 1, 400 / (M_PI * M_PI), 0.01}, Case{20, 1, 1600 / (M_PI * M_PI), 0.0025},
                        Case{5, 300, 4 * 300, 5.0 / 300}, Case{3, 1000, 2 * 1000, 3.0 / 1000}}) {
    const double rate = rate_of_wire(c.N, c.ratio);
    EXPECT_NEAR(-1 / std::log(rate), c.sweeps_per_e, c.off * c.sweeps_per_e) << "N " << c.N;
    for (const bool top_down : {true, false}) {
      const int more =
          sweeps_of_wire(c.N, c.ratio, 1e-9, top_down) - sweeps_of_wire(c.N, c.ratio, 1e-7, top_down);
      EXPECT_NEAR(more, std::log(100) / -std::log(rate), 2) << "N " << c.N << ", M/m " << c.ratio;
    }
  }
  // The equal one in closed form: S has the eigenvectors cos((i - 1)θ), cos(Nθ) = 0, and ρ = cos²(π/2N).
  EXPECT_NEAR(rate_of_wire(20, 1), std::pow(std::cos(M_PI / 40), 2), 1e-12);
}

World<3> swing(const std::vector<double>& stiffnesses) {
  World<3> world({.d = 2, .solver_limits = patient});
  const int anchor = world.add_fixed(Vec3::Zero());
  const int body = world.add({.x = Vec3(1, 0, 0), .mass = 0.6});
  for (const double k : stiffnesses) world.add_joint({.i = anchor, .j = body, .length = 1, .k = k});
  return world;
}

TEST(Loop, OfTheSameRowTwiceIsOneOfTwiceTheStiffness) {
  // (S + Σ) λ1 + S λ2 = B and S λ1 + (S + Σ) λ2 = B: λ1 = λ2, and (S + Σ/2)(λ1 + λ2) = B.
  World<3> twice = swing({1e4, 1e4}), once = swing({2e4});
  for (int step = 0; step < 300; ++step) {
    twice.step(1.0 / 60);
    once.step(1.0 / 60);
    ASSERT_NEAR((twice.x(1) - once.x(1)).norm(), 0, 1e-9) << "step " << step;
    ASSERT_NEAR(twice.joint_lambda(0), twice.joint_lambda(1), 1e-10);
    ASSERT_NEAR(2 * twice.joint_lambda(0), once.joint_lambda(0), 1e-9);
  }
  EXPECT_GT((once.x(1) - Vec3(1, 0, 0)).norm(), 0.1) << "it should swing";
}

TEST(BallJoint, OfTwoPointMassesMakesThemOne) {
  // The gap and its rate fade, and momentum is conserved: both end with the velocity of their centre of mass, at one
  // place.
  World<3> world({.gravity = Vec3::Zero(), .k = 1e6, .d = 1});
  world.add({.v = Vec3(1, 2, 0), .mass = 1});
  world.add({.v = Vec3(-1, 0, 3), .mass = 3});
  world.add_joint({.i = 0, .j = 1});
  for (int step = 0; step < 200; ++step) world.step(0.01);
  EXPECT_EQ(world.report().rows, 3);
  const Vec3 v = (Vec3(1, 2, 0) + 3 * Vec3(-1, 0, 3)) / 4;
  EXPECT_NEAR((world.v(0) - v).norm(), 0, 1e-13);
  EXPECT_NEAR((world.v(1) - v).norm(), 0, 1e-13);
  EXPECT_NEAR((world.x(0) - world.x(1)).norm(), 0, 1e-13);
  EXPECT_NEAR((world.x(0) - 2 * v).norm(), 0, 3 * 0.01) << "they are where their centre of mass is";
}

TEST(BallJoint, HangsABodyByAPointInItsOwnAxes) {
  // Hung by a point above its centre it rests, for any direction of its axes. The joint carries its weight, and yields
  // by T/k.
  const double m = 2, k = 1e5, h = 1.0 / 60;
  const Quat q = Quat(1, 2, -3, 0.5).normalized();
  const Vec3 up(0, 0, 0.4);
  World<6> world({.k = k, .solver_limits = patient});
  const int anchor = world.add_fixed(Vec3(1, 2, 3));
  const int body = world.add({.x = Vec3(1, 2, 3) - up, .mass = m, .q = q, .principal = Vec3(0.1, 0.2, 0.25)});
  world.add_joint({.i = anchor, .j = body, .p_j = q.conjugate() * up});
  for (int step = 0; step < 600; ++step) world.step(h);
  EXPECT_EQ(world.report().rows, 3);
  const Vec3 rest = Vec3(1, 2, 3) - up - m * g / k * Vec3::UnitZ();
  EXPECT_NEAR((world.x(body) - rest).norm(), 0, 1e-12);
  EXPECT_LE(orientation(world, body).angularDistance(q), 1e-7);
  EXPECT_NEAR((impulse_of_ball_joint(world, 0) - h * m * g * Vec3::UnitZ()).norm(), 0, 1e-9);
}

/// The difference of a box that swings about one of its axes from the compound pendulum, after 1.5 s.
double box_error(double h, bool by_distance) {
  const double m = 1.5, s = 0.5;
  const Vec3 half(0.1, 0.2, 0.5);
  const Vec3 I = solid_box_moments(m, half);
  const double angle = 1;
  // Its axes are those of the world, turned by the angle about y. From the centre, s along its own z, to the hook.
  const Quat q(Eigen::AngleAxisd(-angle, Vec3::UnitY()));
  const Vec3 hung = s * Vec3::UnitZ();
  const double rate2 = m * g * s / (I.y() + m * s * s);
  const double spin = h / 2 * rate2 * std::sin(angle);  // half a step back, Eq. (1.5)
  World<6> world({.k = 1e10, .solver_limits = patient});
  const Vec3 x = q * -hung;
  const Vec3 omega = -spin * Vec3::UnitY();
  const int body = world.add({.x = x, .v = omega.cross(x), .mass = m, .q = q, .omega = omega, .principal = I});
  if (by_distance) {
    // Two rods to the ends of an axle through the point, along the axis of the swing, and one across: together they
    // hold the point as a ball joint does.
    for (const Vec3& from : {Vec3(0, 1, 0), Vec3(0, -1, 0.2), Vec3(1, 0, 0.1)}) {
      const int anchor = world.add_fixed(from);
      world.add_joint({.i = body, .j = anchor, .p_i = hung, .length = from.norm()});
    }
  } else {
    const int anchor = world.add_fixed(Vec3::Zero());
    world.add_joint({.i = body, .j = anchor, .p_i = hung});
  }
  const PlanePendulum answer(angle, std::sqrt(rate2));
  double error = 0;
  for (int n = 1; n <= std::lround(1.5 / h); ++n) {
    world.step(h);
    const PlanePendulum::Direction theta = answer.direction(n * h);
    error = std::max(error, (world.x(body) - s * Vec3(theta.sin, 0, -theta.cos)).norm() / s);
  }
  return error;
}

TEST(BallJoint, SwingsABoxAsACompoundPendulum) {
  testing::expect_order(
      "a box on a ball joint", "", [](double h) { return box_error(h, false); }, 0.01, 3, 2, 0.1);
  EXPECT_LE(box_error(0.001, false), 1e-3);
}

TEST(Distance, HoldsPointsBesideTheCentres) {
  testing::expect_order(
      "a box on three rods", "", [](double h) { return box_error(h, true); }, 0.01, 2, 2, 0.1);
  EXPECT_LE(box_error(0.0025, true), 6e-3);
}

// Refused input

TEST(Input, JointsOfPoints) {
  World<3> world({});
  const int a = world.add({}), b = world.add({.x = Vec3(1, 0, 0)});
  const int fixed = world.add_fixed(Vec3(0, 1, 0)), other = world.add_fixed(Vec3(0, 2, 0));
  const int on_a = world.add({});
  expect_refusal({"body", "7"}, [&] { world.add_joint({.i = 7, .j = b}); });
  expect_refusal({"body", "-1"}, [&] { world.add_joint({.i = a, .j = -1}); });
  expect_refusal({"joint's j", "1"}, [&] { world.add_joint({.i = b, .j = b}); });
  expect_refusal({"joint's j", "3", "moves"}, [&] { world.add_joint({.i = fixed, .j = other}); });
  expect_refusal({"p_i", "0.5"},
                 [&] { world.add_joint({.i = a, .j = b, .p_i = Vec3(0, 0.5, 0), .length = 1}); });
  expect_refusal({"p_j", "0.25"}, [&] { world.add_joint({.i = a, .j = b, .p_j = Vec3(0, 0, 0.25)}); });
  expect_refusal({"p_j", "nan"}, [&] { world.add_joint({.i = a, .j = b, .p_j = Vec3(0, nan, 0)}); });
  for (const double length : {0.0, -1.0, infinity, nan})
    expect_refusal({"length"}, [&] { world.add_joint({.i = a, .j = b, .length = length}); });
  expect_refusal({"length", "-2"}, [&] { world.add_joint({.i = a, .j = b, .length = -2}); });
  expect_refusal({"distance", "0"}, [&] { world.add_joint({.i = a, .j = on_a, .length = 1}); });
  for (const double k : {0.0, -1.0, infinity, nan})
    expect_refusal({"k"}, [&] { world.add_joint({.i = a, .j = b, .length = 1, .k = k}); });
  expect_refusal({"k", "-3"}, [&] { world.add_joint({.i = a, .j = b, .k = -3}); });
  for (const double d : {-1.0, infinity, nan})
    expect_refusal({"d"}, [&] { world.add_joint({.i = a, .j = b, .length = 1, .d = d}); });
  expect_refusal({"d", "-0.5"}, [&] { world.add_joint({.i = a, .j = b, .d = -0.5}); });
  EXPECT_TRUE(world.joints().empty()) << "a refused joint must leave no trace";
  EXPECT_NO_THROW(world.add_joint({.i = a, .j = on_a}))
      << "a ball joint may be at the place where it is closed";
}

TEST(Input, JointsOfBodies) {
  World<6> world({});
  const int a = world.add({.principal = Vec3::Ones()}),
            b = world.add({.x = Vec3(1, 0, 0), .principal = Vec3::Ones()});
  expect_refusal({"p_i", "inf"}, [&] { world.add_joint({.i = a, .j = b, .p_i = Vec3(infinity, 0, 0)}); });
  expect_refusal({"distance", "0"}, [&] {
    world.add_joint({.i = a, .j = b, .p_i = Vec3(0.5, 0, 0), .p_j = Vec3(-0.5, 0, 0), .length = 1});
  });
  const int joint = world.add_joint({.i = a, .j = b, .p_i = Vec3(0.5, 0, 0), .length = 1});
  EXPECT_EQ(world.joint_lambda(joint), 0) << "a new joint has had no impulse";
  expect_refusal({"joint", "1"}, [&] { world.joint_lambda(1); });
  expect_refusal({"joint", "-1"}, [&] { world.joint_lambda(-1); });
  expect_refusal({"row", "1"}, [&] { world.joint_lambda(joint, 1); });
  expect_refusal({"row", "-1"}, [&] { world.joint_lambda(joint, -1); });
}

TEST(Input, AJointThatIsNewIsNotMistakenForAContact) {
  World<3> world({});
  world.add_plane(Vec3::UnitZ(), 0);
  const int body = world.add({.x = Vec3(0, 0, 0.5), .radius = 0.5});
  world.step(0.01);
  EXPECT_GT(world.lambda(0), 0);
  const int joint = world.add_joint({.i = 0, .j = body});
  EXPECT_EQ(world.joint_lambda(joint), 0);
  world.step(0.01);
  EXPECT_EQ(world.report().rows, 4);
  EXPECT_NE(world.joint_lambda(joint, 2), world.lambda(0));
}

// Failures during a run

/// Two points that fly at each other, joined by a distance far too soft to matter: they coincide after 1/h steps.
class Collapse : public WorldScene<3> {
 public:
  Collapse(const Parameters&, const Method& method) : WorldScene({.gravity = Vec3::Zero()}, method) {
    world_.add({.x = Vec3(5, 0, 0)});
    world_.add({.x = Vec3(-1, 0, 0), .v = Vec3(1, 0, 0)});
    world_.add({.x = Vec3(1, 0, 0), .v = Vec3(-1, 0, 0)});
    world_.add_joint({.i = 1, .j = 2, .length = 2, .k = 1e-30});
  }
  void observe() override {}
  double error() const override { return 0; }
  std::vector<std::string> columns() const override { return {"time [s]", "x [m]"}; }
  std::vector<double> sample() const override { return {time(), world_.x(2).x()}; }
};

TEST(SimulationDiverged, NamesTheBodyOfADistanceWithoutDirectionAndLeavesWhatWasWritten) {
  SceneDescription scene;
  scene.build = build_as<Collapse>;
  std::ostringstream csv;
  try {
    run(scene, Parameters({}), {.method = {.h = 0.25}, .time = 3}, {.csv = &csv});
    FAIL() << "no SimulationDiverged";
  } catch (const SimulationDiverged& diverged) {
    EXPECT_EQ(diverged.step(), 5) << "the first step that begins with both at one place";
    EXPECT_EQ(diverged.time(), 1.25);
    EXPECT_EQ(diverged.body(), 2);
    EXPECT_STREQ(diverged.what(),
                 "blew up in step 5 (time 1.25 s): body 2 is at distance 0 of the body that it is joined to");
  }
  EXPECT_EQ(csv.str(), "time [s],x [m]\n0,1\n0.25,0.75\n0.5,0.5\n0.75,0.25\n1,0\n");
}

TEST(SimulationDiverged, OfADistanceLeavesTheStepBefore) {
  World<3> world({});
  world.add_plane(Vec3::UnitZ(), 0);
  world.add({.x = Vec3(0, 0, 0.5), .mass = 2, .radius = 0.5});
  const int left = world.add({.x = Vec3(4, 0, 9), .v = Vec3(1, 0, 0)});
  const int right = world.add({.x = Vec3(6, 0, 9), .v = Vec3(-1, 0, 0)});
  const int joint = world.add_joint({.i = left, .j = right, .length = 2, .k = 1e-30});
  for (int step = 0; step < 4; ++step) world.step(0.25);
  const double contact_lambda = world.lambda(0), joint_lambda = world.joint_lambda(joint);
  EXPECT_GT(contact_lambda, 0);
  EXPECT_THROW(world.step(0.25), SimulationDiverged);
  EXPECT_EQ(world.steps(), 4);
  EXPECT_EQ(world.x(left), world.x(right));
  EXPECT_EQ(world.lambda(0), contact_lambda);
  EXPECT_EQ(world.joint_lambda(joint), joint_lambda);
}

TEST(SimulationDiverged, IsWhatAnInfiniteDistanceIs) {
  // |x| is finite, but its square overflows.
  World<3> world({.gravity = Vec3::Zero()});
  world.add({.v = Vec3(1e200, 0, 0)});
  world.add({.x = Vec3(0, 1, 0)});
  world.add_joint({.i = 0, .j = 1, .length = 1, .k = 1e-300});
  EXPECT_NO_THROW(world.step(1));
  EXPECT_THROW(world.step(1), SimulationDiverged);
}

// Timing

TEST(StageTimes, OfJointsAreRowsAndSolve) {
  using Names = std::vector<std::string>;
  const auto ran = [](const auto& world) {
    Names names;
    for (std::size_t s = 0; s < stage_names.size(); ++s) {
      EXPECT_EQ(world.stage_times().runs[s] > 0, world.stage_times().seconds[s] > 0) << stage_names[s];
      if (world.stage_times().runs[s] > 0) names.push_back(stage_names[s]);
    }
    return names;
  };
  World<3> world({});
  world.add_fixed(Vec3::Zero());
  world.add({.x = Vec3(1, 0, 0)});
  world.step(0.01);
  EXPECT_EQ(ran(world), Names{}) << "timing is off by default";
  world.time_stages();
  world.step(0.01);
  EXPECT_EQ(ran(world), (Names{"forces", "integrate"}));
  world.add_joint({.i = 0, .j = 1, .length = 1});
  world.step(0.01);
  EXPECT_EQ(ran(world), (Names{"forces", "rows", "solve", "integrate"})) << "no body has a shape";
}

}  // namespace
}  // namespace spook::joint_test
