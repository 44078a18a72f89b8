// Pendulums, wires, ropes and cloth against their answers, and the answers against independent results.
#include <gtest/gtest.h>

#include <cmath>

#include "algebra.hpp"
#include "checks.hpp"
#include "refusals.hpp"
#include "scene_runs.hpp"
#include "scenes/degrees.hpp"
#include "scenes/hanging_chain.hpp"
#include "scenes/plane_pendulum.hpp"
#include "scenes/reference_motion.hpp"

namespace spook::joint_scenes_test {
namespace {

using testing::expect_order;
using testing::solution_of;
using testing::sweep_matrix;

constexpr double epsilon = 2.2e-16;
constexpr double g = 9.81;

SceneSettings operator+(SceneSettings a, const SceneSettings& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

double largest_difference(const std::vector<double>& a, const std::vector<double>& b) {
  double difference = 0;
  for (std::size_t n = 0; n < a.size(); ++n) difference = larger(difference, std::abs(a[n] - b[n]));
  return difference;
}

// The mathematics

TEST(ReferenceMotion, IsRightToRoundingsWhateverTheWay) {
  using Motion = ReferenceMotion<2>;
  const auto oscillator = [](const Motion::State& y) { return Motion::State(y[1], -y[0]); };
  Motion in_one_go(oscillator, {1, 0}), bit_by_bit(oscillator, {1, 0});
  const double end = 40;
  for (int n = 1; n <= 3000; ++n) bit_by_bit.at(n * end / 3000);
  for (const Motion::State& y : {in_one_go.at(end), bit_by_bit.at(end)}) {
    EXPECT_NEAR(y[0], std::cos(end), 3e-12);
    EXPECT_NEAR(y[1], -std::sin(end), 3e-12);
  }
  // y' = y² has its pole at t = 1.
  ReferenceMotion<1> burst(
      [](const ReferenceMotion<1>::State& y) { return ReferenceMotion<1>::State(y * y[0]); },
      ReferenceMotion<1>::State(1));
  EXPECT_NEAR(burst.at(0.99)[0], 100, 1e-8);
  EXPECT_THROW(burst.at(2), std::runtime_error);
}

TEST(PlanePendulum, SolvesItsEquation) {
  using Motion = ReferenceMotion<2>;
  const double rate = 3.1;
  for (const double degrees : {0.001, 30.0, 90.0, 150.0, 179.0, 179.99}) {
    const PlanePendulum pendulum(radians(degrees), rate);
    Motion integrated(
        [&](const Motion::State& y) { return Motion::State(y[1], -rate * rate * std::sin(y[0])); },
        {radians(degrees), 0});
    for (double t = 0; t < 8; t += 0.05) {
      const PlanePendulum::Direction theta = pendulum.direction(t);
      const Motion::State& y = integrated.at(t);
      // Near the top, round-off in the angle grows as exp(ωt) until it falls.
      const double roundings = 1e-11 / std::cos(radians(degrees) / 2);
      ASSERT_NEAR(theta.sin, std::sin(y[0]), roundings) << degrees << " degrees, " << t << " s";
      ASSERT_NEAR(theta.cos, std::cos(y[0]), roundings) << degrees << " degrees, " << t << " s";
    }
    const double T = pendulum.period();
    EXPECT_NEAR(pendulum.direction(T).cos, std::cos(radians(degrees)), 1e-11);
    EXPECT_NEAR(pendulum.direction(T / 4).sin, 0, 1e-11);
    EXPECT_NEAR(pendulum.direction(T / 2).sin, -std::sin(radians(degrees)), 1e-11);
  }
}

TEST(PlanePendulum, HasItsPeriod) {
  // From 90°, Γ(1/4)²/√π √(l/g); of small swings 2π √(l/g) (1 + θ²/16 + 11 θ⁴/3072 + …).
  const double rate = std::sqrt(10);
  EXPECT_NEAR(PlanePendulum(M_PI / 2, rate).period(), std::pow(std::tgamma(0.25), 2) / std::sqrt(M_PI) / rate,
              1e-14);
  EXPECT_NEAR(PlanePendulum(M_PI / 2, rate).period(), 2.34524, 5e-6);
  const double a = 0.1;
  EXPECT_NEAR(PlanePendulum(a, rate).period() * rate / (2 * M_PI), 1 + a * a / 16 + 11 * std::pow(a, 4) / 3072,
              std::pow(a, 6) / 100);
}

TEST(HangingChain, IsInBalanceAndOfItsLength) {
  for (const int N : {2, 3, 10, 101})
    for (const double k : {infinity, 1e6, 300.0}) {
      const double l = 1.0 / N, weight = 9.81 / N, span = 0.7;
      const HangingChain chain = hanging_chain(N, l, span, weight, k);
      ASSERT_EQ(chain.x.size(), static_cast<std::size_t>(N) + 1);
      const std::string which = std::to_string(N) + " links, k " + exact_text(k);
      EXPECT_NEAR((chain.x.back() - span * Vec3::UnitX()).norm(), 0, 20 * N * epsilon) << which;
      for (std::size_t i = 0; i < chain.tension.size(); ++i) {
        const Vec3 link = chain.x[i + 1] - chain.x[i];
        EXPECT_NEAR(link.norm(), l + chain.tension[i] / k, 20 * N * epsilon) << which;
        if (i == 0) continue;
        const Vec3 before = chain.x[i] - chain.x[i - 1];
        const Vec3 force = chain.tension[i] * link.normalized() - chain.tension[i - 1] * before.normalized() -
                           weight * Vec3::UnitZ();
        // A link is 1/N long, so that round-off of x turns it by N times as much.
        EXPECT_NEAR(force.norm(), 0, 100 * N * N * epsilon * weight * N) << which << ", point " << i;
      }
    }
}

TEST(HangingChain, BecomesTheCatenary) {
  // z = a cosh(x/a), 2a sinh(span/2a) = length; its tension at the ends is w a cosh(span/2a), w its weight per metre.
  const double a = 0.5, span = 0.8, length = 2 * a * std::sinh(span / 2 / a),
               sag = a * std::cosh(span / 2 / a) - a;
  const auto sag_error = [&](double l) {
    const int N = 2 * static_cast<int>(std::lround(length / l / 2));
    const HangingChain chain = hanging_chain(N, length / N, span, 1 * length / N, infinity);
    return std::abs(chain.x[static_cast<std::size_t>(N / 2)].z() + sag);
  };
  expect_order("sag of a chain of rigid links", "", sag_error, length / 10, 4, 2, 0.05);
  const HangingChain fine = hanging_chain(2000, length / 2000, span, length / 2000, infinity);
  EXPECT_NEAR(fine.sideways, a, 1e-5);
  // Each end carries half a link's weight, which the chain does not.
  EXPECT_NEAR(fine.tension.front(), a * std::cosh(span / 2 / a), length / 2000);
}

TEST(HangingChain, RefusesWhatHasNoShape) {
  expect_refusal({"span", "0.1"}, [] { hanging_chain(10, 0.1, 0.1, 1, infinity); });
  expect_refusal({"span", "1"}, [] { hanging_chain(10, 0.1, 1.0, 1, infinity); });
  EXPECT_NO_THROW(hanging_chain(10, 0.1, 1.5, 1, 100)) << "yielding links may be stretched";
}

// pendulum

TEST(PendulumScene, IsOfSecondOrderForBothModels) {
  for (const std::string model : {"point", "body"})
    for (const std::string angle : {"1", "30", "90", "120"}) {
      const auto error = [&](double h) {
        return error_of("pendulum", {{"model", model}, {"angle", angle}, {"k", "1e12"}}, h, 3,
                        {.max_sweeps = 1000});
      };
      expect_order("pendulum, " + model + " from " + angle, "", error, 0.004, 3, 2, 0.1);
    }
  const auto unshifted = [](double h) {
    return error_of("pendulum", {{"angle", "60"}, {"k", "1e12"}, {"start", "unshifted"}}, h, 3);
  };
  expect_order("pendulum, unshifted", "", unshifted, 0.004, 3, 1, 0.05);
  EXPECT_GT(unshifted(0.001), 5 * error_of("pendulum", {{"angle", "60"}, {"k", "1e12"}}, 0.001, 3));
}

TEST(PendulumScene, HasTheGapOfItsAcceleration) {
  // (1 + 2d) h² A/4 + T/k, A = v²/l = 2g (cos θ - cos θ0), is largest at the bottom. It lags by some d h.
  const double k = 1e6, m = 2;
  for (const double d : {0.5, 3.0})
    for (const double h : {0.002, 0.001}) {
      const SceneRun run =
          run_of("pendulum", {{"d", exact_text(d)}, {"k", exact_text(k)}, {"m", exact_text(m)}}, h, 1);
      const double A = 2 * g, T = m * (A + g);
      const std::vector<double>& gaps = run.all("gap [m]");
      const double answer = (1 + 2 * d) * h * h * A / 4 + T / k;
      EXPECT_NEAR(*std::max_element(gaps.begin(), gaps.end()), answer, (1 + d) * h * answer)
          << "d " << d << ", h " << h;
    }
}

TEST(PendulumScene, LosesEnergyAsTheSquareOfDAndTheCubeOfH) {
  // (3/4) m d² h³ ∫ A'² dt, from 90° with l = 1: A' = -2g θ' sin θ, θ'² = 2g cos θ, and over a period
  // ∫ A'² dt = 4 (2g)^(5/2) ∫ sin²θ √cosθ dθ from 0 to π/2, which is B(3/2, 3/4)/2.
  const double beta = std::tgamma(1.5) * std::tgamma(0.75) / std::tgamma(2.25);
  const double integral = 4 * std::pow(2 * g, 2.5) * beta / 2;
  const double period = PlanePendulum(M_PI / 2, std::sqrt(g)).period();
  for (const double d : {0.25, 1.0, 3.0})
    for (const double h : {0.002, 0.001}) {
      const SceneRun run = run_of("pendulum", {{"d", exact_text(d)}, {"k", "1e12"}}, h, period);
      const std::vector<double>& energy = run.all("energy [J]");
      const double lost = energy.front() - energy.back();
      // The next order is smaller by d h √(g/l). (The period ends between two steps: at its end A' is small.)
      EXPECT_NEAR(lost, 0.75 * d * d * h * h * h * integral, 0.05 * lost) << "d " << d << ", h " << h;
    }
}

TEST(PendulumScene, HasTheTensionOfItsMotion) {
  // T = m g (3 cos θ - 2 cos θ0), with θ at the begin of the step.
  const auto error = [](const std::string& model, double h) {
    const SceneSettings settings = {
        {"model", model}, {"angle", "60"}, {"m", "2"}, {"k", "1e12"}, {"radius", "0.1"}};
    const SceneRun run = run_of("pendulum", settings, h, 2, {.max_sweeps = 10'000, .tolerance = 1e-12});
    // A rigid body is slower at the bottom, since it also rotates: A = 2 (m g l/I) l (cos θ - cos θ0).
    const double inertia = model == "body" ? 1 + 0.4 * 0.01 : 1;
    double off = 0;
    for (std::size_t n = 1; n < run.all("tension [N]").size(); ++n) {
      const double cosine = std::cos(radians(run.all("answer [degrees]")[n - 1]));
      off = larger(off, std::abs(run.all("tension [N]")[n] - 2 * g * (cosine + 2 / inertia * (cosine - 0.5))));
    }
    return off / (2 * g);
  };
  expect_order(
      "tension of the rod", "", [&](double h) { return error("point", h); }, 0.004, 3, 2, 0.1);
  // That of the body is measured along the rod of the next step. There is no force across the rod, so the error is of
  // second order, too.
  expect_order(
      "pull of the ball joint", "", [&](double h) { return error("body", h); }, 0.004, 3, 2, 0.1);
}

TEST(PendulumScene, TurnsWithItsRodAsABody) {
  // ω² = g/(l + 2r²/(5l)): with r = l a slower swing by √1.4, which the error would show.
  const double h = 0.001;
  EXPECT_LE(error_of("pendulum", {{"model", "body"}, {"radius", "1"}}, h, 3), 1e-3);
  const SceneRun point = run_of("pendulum", {}, h, 3);
  const SceneRun body = run_of("pendulum", {{"model", "body"}, {"radius", "1"}}, h, 3);
  EXPECT_GT(largest_difference(point.all("angle [degrees]"), body.all("angle [degrees]")), 30);
}

TEST(PendulumScene, HangsStillOrStaysNearTheTop) {
  // At rest it only yields by m g/k.
  EXPECT_NEAR(run_of("pendulum", {{"angle", "0"}, {"k", "1e6"}}, 0.001, 1).last("gap [m]"), g / 1e6,
              4 * epsilon);
  EXPECT_LE(error_of("pendulum", {{"g", "0"}}, 0.001, 1), 4 * epsilon);
  // The fall from 179.9° takes its time: until then an error grows as exp(ωt), about a thousandfold.
  const auto error = [](double h) { return error_of("pendulum", {{"angle", "179.9"}, {"k", "1e12"}}, h, 2); };
  EXPECT_LE(error(0.001), 1e-2);
  expect_order("pendulum, from near the top", "", error, 0.001, 2, 2, 0.1);
}

// double_pendulum

/// The same two masses in Cartesian coordinates: no angles, but the tensions that hold both lengths.
struct Cartesian {
  double l1, l2, m1, m2;
  using State = Eigen::Matrix<double, 8, 1>;  // x1, z1, x2, z2 and their rates

  State rate(const State& y) const {
    using Eigen::Vector2d;
    const Vector2d x1 = y.segment<2>(0), x2 = y.segment<2>(2) - x1, v1 = y.segment<2>(4),
                   v2 = y.segment<2>(6) - v1;
    // x2 and v2 from mass 1. With tensions s per length, x1'' = g + (s2 x2 - s1 x1)/m1 and x2'' = s1 x1/m1 - s2 x2
    // (1/m1 + 1/m2). The lengths are constant for x1·x1'' = -v1² and x2·x2'' = -v2².
    const Vector2d weight(0, -g);
    Eigen::Matrix2d A;
    A << x1.dot(x1) / m1, -x1.dot(x2) / m1, -x1.dot(x2) / m1, x2.dot(x2) * (1 / m1 + 1 / m2);
    const Vector2d s = A.inverse() * Vector2d(v1.dot(v1) + x1.dot(weight), v2.dot(v2));
    State dot;
    dot << y.tail<4>(), weight + (s[1] * x2 - s[0] * x1) / m1, weight - s[1] * x2 / m2;
    return dot;
  }
};

TEST(DoublePendulumScene, AnswerIsThatOfTheTensions) {
  const Cartesian rods{0.8, 1.1, 1.5, 0.7};
  const SceneSettings settings = {{"l1", "0.8"}, {"l2", "1.1"},     {"m1", "1.5"},
                                  {"m2", "0.7"}, {"angle1", "100"}, {"angle2", "-20"}};
  const double h = 0.01, time = 2;
  const SceneRun run = run_of("double_pendulum", settings, h, time);
  Cartesian::State start = Cartesian::State::Zero();
  start.head<2>() = 0.8 * Eigen::Vector2d(std::sin(radians(100)), -std::cos(radians(100)));
  start.segment<2>(2) =
      start.head<2>() + 1.1 * Eigen::Vector2d(std::sin(radians(-20)), -std::cos(radians(-20)));
  ReferenceMotion<8> motion([&](const Cartesian::State& y) { return rods.rate(y); }, start);
  for (int n = 0; n <= std::lround(time / h); ++n) {
    const Cartesian::State& y = motion.at(n * h);
    // Both are right to some 1e-13 a step, and the motion multiplies that by about ten in the time.
    ASSERT_NEAR(run.all("answer x [m]")[static_cast<std::size_t>(n)], y[2], 1e-9) << "step " << n;
    ASSERT_NEAR(run.all("answer z [m]")[static_cast<std::size_t>(n)], y[3], 1e-9) << "step " << n;
  }
}

TEST(DoublePendulumScene, SwingsInItsTwoModes) {
  // Equal rods and masses, small angles: θ2 = ±√2 θ1 swing with ω² = (2 ∓ √2) g/l.
  for (const double sign : {1.0, -1.0}) {
    const double small = 0.01, ratio = sign * std::sqrt(2), rate = std::sqrt((2 - ratio) * g);
    const SceneRun run = run_of(
        "double_pendulum", {{"angle1", exact_text(small)}, {"angle2", exact_text(ratio * small)}}, 0.01, 3);
    const double amplitude = radians(small) * (1 + ratio);
    for (std::size_t n = 0; n < run.all("time [s]").size(); ++n)
      // The angle's third power is neglected in the force, and so in the rate.
      ASSERT_NEAR(run.all("answer x [m]")[n], amplitude * std::cos(rate * run.all("time [s]")[n]),
                  10 * (1 + rate * run.all("time [s]")[n]) * std::pow(radians(small), 3))
          << "mode " << sign << ", step " << n;
  }
}

TEST(DoublePendulumScene, IsOfSecondOrder) {
  const auto error = [](const SceneSettings& more) {
    return [=](double h) { return error_of("double_pendulum", SceneSettings{{"k", "1e12"}} + more, h, 1.5); };
  };
  expect_order("double pendulum", "", error({}), 0.002, 2, 2, 0.1);
  expect_order("double pendulum, from below", "", error({{"angle1", "40"}, {"angle2", "-30"}}), 0.002, 2, 2,
               0.1);
  expect_order("double pendulum, unequal", "", error({{"m2", "0.2"}, {"l2", "0.6"}, {"angle1", "130"}}), 0.002,
               2, 2, 0.1);
  expect_order("double pendulum, unshifted", "",
               error({{"start", "unshifted"}, {"angle1", "40"}, {"angle2", "-30"}}), 0.002, 2, 1, 0.1);
}

TEST(DoublePendulumScene, RefusesWhatItsAnswerCannotFollow) {
  const SceneDescription& scene = find_scene("double_pendulum");
  const auto build = [&](const SceneSettings& settings, double h) {
    scene.build(with(scene, settings), {.h = h});
  };
  expect_refusal({"m2/m1", "20000"}, [&] { build({{"m1", "0.5"}, {"m2", "1e4"}}, 0.001); });
  expect_refusal({"l2/l1", "1e-05"}, [&] { build({{"l2", "1e-5"}}, 0.001); });
  expect_refusal({"h", "5"}, [&] { build({}, 5); });
  EXPECT_NO_THROW(build({{"g", "0"}}, 5)) << "without gravity nothing moves";
}

// wire

TEST(WireScene, IsRightOnceGaussSeidelIs) {
  const StopRule patient = {.max_sweeps = 100'000, .tolerance = 1e-13};
  for (const std::string model : {"point", "body"})
    for (const std::string begin : {"natural", "at_rest"})
      for (const std::string d : {"0.5", "3", "10"}) {
        const SceneSettings settings = {
            {"model", model}, {"begin", begin}, {"d", d}, {"m", "2"}, {"ratio", "5"}};
        const SceneRun run = run_of("wire", settings, 1.0 / 60, 10, patient, "gauss_seidel");
        // Σ T_i = (5 · 5 + 4 + 3 + 2 + 1) m g
        const double stretch = 35 * 2 * g / 1e6;
        // The solve is right to 1e-13/(1 - ρ), ρ = exp(-1/20), in velocity; that changes gaps by 1/a < h (1 + 4d)/4 of
        // it.
        const double slack = 5 * 2e-12 / 60 * 11 + 100 * epsilon;
        EXPECT_NEAR(run.last("stretch [m]"), stretch, slack) << model << ", " << begin << ", d " << d;
        EXPECT_LE(run.error, slack) << "of a wire of 1 m";
        EXPECT_NEAR(run.last("error over the right stretch [-]"), run.error / stretch, 1e-12);
        EXPECT_NEAR(run.last("top tension [N]"), 9 * 2 * g, 1e-4);
        EXPECT_NEAR(run.last("lowest tension [N]"), 5 * 2 * g, 1e-4);
      }
}

TEST(WireScene, IsWrongByWhatTheSweepsLeave) {
  // At rest, s sweeps from λ = 0 must give h T, with the gaps needed for that: λ = (1 - E^s) S⁻¹ B. E is the matrix of
  // Gauss-Seidel, and B = -a gap - h g e1. So a gap = -S (1 - E^s)⁻¹ h T - h g e1.
  const int N = 5, s = 50;
  const double m = 0.01, M = 0.04, h = 1.0 / 60, k = 1e6;
  const SpookParameters spook = spook_parameters(h, k, 3);
  Eigen::MatrixXd S = Eigen::MatrixXd::Zero(N, N);
  Eigen::VectorXd T(N), first = Eigen::VectorXd::Unit(N, 0);
  for (int i = 0; i < N; ++i) {
    S(i, i) = (i == 0 ? 0 : 1 / m) + 1 / (i == N - 1 ? M : m) + spook.Sigma;
    if (i > 0) S(i, i - 1) = S(i - 1, i) = -1 / m;
    T[i] = -(M + (N - 1 - i) * m) * g;  // a pull is negative
  }
  const Eigen::MatrixXd E = sweep_matrix(S);
  Eigen::MatrixXd left = Eigen::MatrixXd::Identity(N, N);
  for (int sweep = 0; sweep < s; ++sweep) left = left * E;
  const Eigen::MatrixXd done = Eigen::MatrixXd::Identity(N, N) - left;
  const double stretch = (-(S * solution_of(done, h * T) + h * g * first) / spook.a).sum();

  const SceneRun run =
      run_of("wire", {{"ratio", "4"}, {"begin", "at_rest"}}, h, 10, {.max_sweeps = s}, "gauss_seidel");
  EXPECT_NEAR(run.last("stretch [m]"), stretch, 1e-9);
  EXPECT_NEAR(run.error, stretch + T.sum() / k, 1e-9) << "of a wire of 1 m";
  EXPECT_GT(run.error, 1e-5) << "which the sweeps should not remove";
}

TEST(WireScene, IsRubberWithFewSweepsAndManyLinks) {
  const auto stretched = [](const std::string& links, const std::string& ratio, double h, int sweeps) {
    return run_of("wire", {{"links", links}, {"ratio", ratio}}, h, 1, {.max_sweeps = sweeps}, "gauss_seidel")
        .last("stretch over length [-]");
  };
  EXPECT_GT(stretched("50", "1000", 1.0 / 60, 50), 1);
  // The same number of sweeps a second, distributed over fifty times as many steps. s sweeps leave a fraction of order
  // 1/s of a sag of order h², so with s proportional to h the rest is of order h.
  EXPECT_NEAR(stretched("20", "10", 1.0 / 3000, 1) / stretched("20", "10", 1.0 / 60, 50), 0.02, 0.01);
}

TEST(WireScene, OfPointsAndOfBodiesAgree) {
  const double h = 1.0 / 60;
  const SceneRun points = run_of("wire", {{"links", "10"}, {"ratio", "10"}}, h, 1);
  const SceneRun bodies = run_of("wire", {{"links", "10"}, {"ratio", "10"}, {"model", "body"}}, h, 1);
  EXPECT_LE(largest_difference(points.all("stretch [m]"), bodies.all("stretch [m]")), 1e-11);
  EXPECT_LE(largest_difference(points.all("top tension [N]"), bodies.all("top tension [N]")), 1e-8);
}

// rope

TEST(RopeScene, StaysOnceGaussSeidelIsRight) {
  const StopRule patient = {.max_sweeps = 100'000, .tolerance = 1e-13};
  for (const std::string links : {"2", "3", "10"})
    for (const std::string d : {"0.5", "3"}) {
      const SceneRun run =
          run_of("rope", {{"begin", "at_rest"}, {"links", links}, {"d", d}}, 1.0 / 240, 2, patient);
      // 480 steps of 1e-13/(1 - ρ) m/s, ρ = cos²(π/10), if all have one direction.
      EXPECT_LE(run.error, 2 * 1e-12) << links << " links, d " << d;
      EXPECT_NEAR(run.last("end tension [N]"), run.last("answer's end [N]"), 1e-5);
      EXPECT_NEAR(run.last("middle tension [N]"), run.last("answer's middle [N]"), 1e-5);
    }
}

TEST(RopeScene, GivesWayByItsStretchFromItsNaturalLength) {
  // Without damping it swings about the answer, no further than its start, except for errors of rows and steps. Its
  // start is as far away as links that yield by T/k allow, to first order in 1/k.
  const StopRule patient = {.max_sweeps = 100'000, .tolerance = 1e-12};
  const double h = 1.0 / 240;
  const auto error = [&](const std::string& k, double time) {
    return error_of("rope", {{"k", k}}, h, time, patient);
  };
  for (const std::string k : {"1e5", "1e6"}) {
    EXPECT_GE(error(k, 1), error(k, 0)) << "k " << k;
    EXPECT_LE(error(k, 1), 1.5 * error(k, 0)) << "k " << k;
  }
  EXPECT_NEAR(error("1e5", 0) / error("1e6", 0), 10, 0.05);
}

TEST(RopeScene, StandsOnlyWhileTheStepFollowsItsTightestLink) {
  // A point moves across its links on a spring of about 4T/l, ω² = 4T/(m l): leapfrog needs h ω < 2.
  const auto ended = [](const std::string& length) {
    const SceneSettings settings = {
        {"begin", "at_rest"}, {"length", length}, {"span", exact_text(0.8 * std::stod(length))}};
    return error_of("rope", settings, 1.0 / 60, 20, {.max_sweeps = 2000, .tolerance = 1e-12});
  };
  // Ten links: m = M/10, l = L/10, and T at the ends is 0.68 M g here.
  const HangingChain chain = hanging_chain(10, 0.1, 0.8, 0.1, infinity);
  const double h = 1.0 / 60, critical = h * h * chain.tension.front() * g * 100;  // L of h ω = 2
  EXPECT_LE(ended(exact_text(1.5 * critical)), 1e-9);
  EXPECT_GE(ended(exact_text(0.5 * critical)), 1e-2);
}

TEST(RopeScene, RefusesWhatCannotHang) {
  const SceneDescription& scene = find_scene("rope");
  const auto build = [&](const SceneSettings& settings) { scene.build(with(scene, settings), {.h = 0.01}); };
  expect_refusal({"span", "length", "1"}, [&] { build({{"span", "1"}}); });
  expect_refusal({"span", "0.05"}, [&] { build({{"span", "0.05"}}); });
  expect_refusal({"span"}, [&] { build({{"links", "1"}}); });
}

// cloth

TEST(ClothScene, IsHeldByItsWeightAndItsChangeOfMomentum) {
  for (const std::string model : {"point", "body"})
    for (const std::string held : {"four_corners", "two_corners"}) {
      const SceneSettings settings = {{"cells", "6"}, {"model", model}, {"held", held}};
      // For any number of sweeps. A step rounds some thousand times at the size of a point's momentum, m v/49 < 0.1.
      for (const int sweeps : {1, 50}) {
        const SceneRun run = run_of("cloth", settings, 0.002, 0.4, {.max_sweeps = sweeps}, "gauss_seidel");
        EXPECT_LE(largest_difference(run.all("support z [N]"), run.all("balance z [N]")),
                  8400 * epsilon * 0.1 / 0.002)
            << model << ", " << held << ", " << sweeps << " sweeps";
        EXPECT_GE(run.last("support z [N]"), 0.1) << "it should be held";
      }
    }
}

TEST(ClothScene, IsHeldByItsWeightInTheMean) {
  // Eq. (6.14), as far as (p - p0)/t has faded; p < m 2 m/s for a cloth of 0.3 m.
  const double time = 20;
  const SceneRun run = run_of("cloth", {{"cells", "4"}, {"side", "0.3"}, {"m", "3"}}, 0.002, time);
  double sum = 0;
  for (const double support : run.all("support z [N]")) sum += support;
  const double steps = static_cast<double>(run.all("time [s]").size()) - 1;
  EXPECT_NEAR(sum / steps, 3 * g, 3 * 2 / time);
  EXPECT_NEAR(sum / steps / (3 * g), 1, 0.01);
}

TEST(ClothScene, HoldsItsLengthsOnceItIsSolved) {
  const SceneSettings small = {{"cells", "4"}};
  const auto error = [&](double h, int sweeps, const std::string& solver) {
    return error_of("cloth", small, h, 0.3, {.max_sweeps = sweeps}, solver);
  };
  // The lag of a distance, h² A (1 + 2d)/(4 l), with A about 100 m/s² as its threads of 0.25 m pull taut.
  EXPECT_LE(error(0.002, 50, "auto"), 3e-3);
  // In small steps λ is some d steps behind a changing tension.
  testing::expect_order(
      "lengths of a cloth", "", [&](double h) { return error(h, 50, "auto"); }, 0.001, 3, 1, 0.1);
  EXPECT_NEAR(error(0.002, 2000, "gauss_seidel") / error(0.002, 50, "auto"), 1, 0.01);
  EXPECT_GE(error(0.002, 5, "gauss_seidel"), 10 * error(0.002, 50, "auto"));
}

TEST(ClothScene, IsHeldByTheCornersThatItIsSaidToBe) {
  const SceneDescription& scene = find_scene("cloth");
  const auto rows = [&](const std::string& held) {
    const auto cloth = scene.build(with(scene, {{"cells", "3"}, {"held", held}}), {.h = 0.002});
    cloth->advance(1);
    return cloth->report().rows;
  };
  // 2 · 3 · 4 links, and three rows a corner.
  EXPECT_EQ(rows("four_corners"), 24 + 12);
  EXPECT_EQ(rows("two_corners"), 24 + 6);
  // Held by one side it swings down until its far side hangs below, by about its length.
  const auto lowest = [](const std::string& held) {
    const std::vector<double> z =
        run_of("cloth", {{"cells", "6"}, {"held", held}}, 0.001, 1).all("lowest z [m]");
    return *std::min_element(z.begin(), z.end());
  };
  EXPECT_LT(lowest("two_corners"), -0.9);
  EXPECT_GT(lowest("four_corners"), -0.6);
}

TEST(ClothScene, OfPointsAndOfBodiesMovesAlike) {
  const SceneSettings small = {{"cells", "5"}};
  const SceneRun points = run_of("cloth", small, 0.002, 0.3),
                 bodies = run_of("cloth", small + SceneSettings{{"model", "body"}}, 0.002, 0.3);
  for (const std::string column : {"support z [N]", "largest strain [-]", "lowest z [m]", "energy [J]"})
    EXPECT_LE(largest_difference(points.all(column), bodies.all(column)), 1e-9) << column;
  EXPECT_LT(points.last("lowest z [m]"), -0.02) << "it should fall";
}

}  // namespace
}  // namespace spook::joint_scenes_test
