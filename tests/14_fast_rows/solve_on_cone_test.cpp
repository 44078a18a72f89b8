// One contact, solved at once: it separates, it sticks, or it slides on its cone.
#include <Eigen/Dense>
#include <numbers>

#include "14_fast_rows/fast_rows.hpp"
#include "exercise_test.hpp"
#include "regions.hpp"
#include "relative_scales.hpp"

using namespace spook;
using namespace spook::testing;

namespace {

EXERCISE(SolveOnCone, "14.1 solve_on_cone");

/// Symmetric, with eigenvalues from 0.3 to 3 in any directions: normal and tangents are coupled.
Mat3 coupled_block(Random& random) {
  const Mat3 R = random.rotation().toRotationMatrix();
  const Vec3 values = random.vector(0.3, 3);
  return R * values.asDiagonal() * R.transpose();
}

double friction_of(const Vec3& lambda) {
  return lambda.tail<2>().norm();
}

EXERCISE_TEST(SolveOnCone, SticksWithMuchFriction) {
  for (const double mu : {1e3, 1e6}) {
    const Vec3 q(1, 0.6 * mu, -0.7 * mu);  // |λ_t| = 0.92 μ λ_n
    expect_near_vector("λ of a contact with μ = " + show(mu) + ", S = 1/kg [N s]", "Eq. (14.4)",
                       solve_on_cone(Mat3::Identity(), q, mu), q, roundings(8, mu), {},
                       "μ is any number from 0 on, however large: inside the cone it sticks.");
  }
}

EXERCISE_TEST(SolveOnCone, PartsWhereNothingPresses) {
  Random random;
  for (const double q_n : {0.0, -1e-3, -2.0}) {
    const Vec3 q(q_n, 1, -0.5);
    const Mat3 S = coupled_block(random);
    expect_near_vector(
        "λ of a contact with q_n = " + show(q_n) + " m/s [N s]", "Eq. (14.3)", solve_on_cone(S, q, 0.5),
        Vec3::Zero(), {0, "it separates"},
        {{S.inverse() * q, "This is S⁻¹ q, as if it stuck. Where q_n <= 0 it separates, and λ is 0."}},
        "Without a normal impulse there is no friction: all three are 0.");
  }
  // A wedge: an impulse from the side would satisfy Coulomb's law as well as none.
  const Mat3 S = (Mat3() << 1, 0.9, 0, 0.9, 1, 0, 0, 0, 1).finished();
  const Vec3 held(1, -1.2, 0), q = S * held;
  expect_near_vector(
      "λ of a contact in a wedge, q_n = " + show(q[0]) + " m/s [N s]", "Eq. (14.3)", solve_on_cone(S, q, 2),
      Vec3::Zero(), roundings(1e3),
      {{held, "This sticks, which is on the cone, too. But (14.3) is asked first: if q_n <= 0 it separates."}},
      "Without a normal impulse there is no friction: all three are 0.");
}

EXERCISE_TEST(SolveOnCone, SticksWhereTheConeIsWideEnough) {
  Random random;
  for (int trial = 0; trial < 20 && !::testing::Test::HasFailure(); ++trial) {
    const Mat3 S = coupled_block(random);
    const double mu = random.uniform(0.2, 1), press = random.uniform(0.1, 2), angle = random.uniform(0, 6);
    const Vec3 lambda = press * Vec3(1, 0.9 * mu * std::cos(angle), 0.9 * mu * std::sin(angle));
    const Vec3 q = S * lambda;
    if (q[0] <= 0.01) continue;
    expect_near_vector(
        "λ of a contact that sticks [N s]", "Eq. (14.4)", solve_on_cone(S, q, mu), lambda, roundings(400, 2),
        {{q.cwiseQuotient(Vec3(S.diagonal())),
          "Each row has been divided by its own diagonal, but the rows of a contact are coupled."}},
        "Inside the cone it sticks: S λ = q, all three rows.");
  }
}

EXERCISE_TEST(SolveOnCone, SlidesLikeABall) {
  // Normal and tangents of a ball are not coupled, and both tangents have the same stiffness.
  const Mat3 S = Vec3(0.5, 1.75, 1.75).asDiagonal();
  const double mu = 0.4;
  const Vec3 q(2, -30, 40);
  const Vec2 along = Vec2(-0.6, 0.8) * mu * 4;
  expect_near_vector(
      "λ of a ball that slides [N s]", "Eq. (14.5)", solve_on_cone(S, q, mu), Vec3(4, along[0], along[1]),
      roundings(100, 4),
      {{Vec3(4, -30 / 1.75, 40 / 1.75), "It sticks, with more friction than μ λ_n."},
       {Vec3(4, -mu * 4, mu * 4), "This is a box of ±μ λ_n."},
       {Vec3(4, -along[0], -along[1]), "The sign: λ_t points along q, the velocity to be made up."},
       {Vec3(4, along[0] / mu, along[1] / mu), "μ is missing: |λ_t| = λ_n."}},
      "λ_n = q_n/S_nn, and λ_t is μ times that along q_t.");
}

EXERCISE_TEST(SolveOnCone, DoesWithoutFriction) {
  Random random;
  const Mat3 S = coupled_block(random);
  for (const Vec3& q : {Vec3(1.5, 1, -2), Vec3(1.5, 0, 0), Vec3(1.5e-12, 1, -2)})
    expect_near_vector("λ with μ = 0 [N s]", "Eq. (14.5)", solve_on_cone(S, q, 0), Vec3(q[0] / S(0, 0), 0, 0),
                       roundings(10, q[0] / S(0, 0)), {},
                       "There is no friction: this is chapter 04's single row.");
}

EXERCISE_TEST(SolveOnCone, DropsNothingSmall) {
  const Mat3 S = Vec3(2, 4, 4).asDiagonal();
  for (const double part : relative_scales) {
    const double length = std::hypot(1, part);
    expect_each_near<Vec3>("λ of a contact that sticks, with little friction [N s]", "Eq. (14.4)",
                           solve_on_cone(S, Vec3(2, part, -part / 2), 0.5), Vec3(1, part / 4, -part / 8), 16);
    expect_each_near<Vec3>("λ of a contact that slides nearly along a tangent [N s]", "Eq. (14.5)",
                           solve_on_cone(S, Vec3(2, 40, 40 * part), 0.5),
                           Vec3(1, 0.5 / length, 0.5 * part / length), 100);
    expect_each_near<Vec3>("λ of a contact that slides with μ = " + show(part) + " [N s]", "Eq. (14.5)",
                           solve_on_cone(S, Vec3(2, -30, 40), part), Vec3(1, -0.6 * part, 0.8 * part), 100);
    if (::testing::Test::HasFailure()) return;
  }
}

/// Checks Eq. (14.3)-(14.5) for a result.
void expect_coulomb(const Mat3& S, const Vec3& q, double mu, const Vec3& lambda) {
  const Vec3 lacks = q - S * lambda;
  const Tolerance close = roundings(1e4, q.norm() + lambda.norm());
  expect_at_least(
      "λ_n [N s]", "Eq. (14.3)", lambda[0], 0, "contacts never pull",
      "Where λ_n of sticking is negative, it does not stick: |λ_t| <= μ λ_n does not hold then, but the "
      "squares of both sides do not see the sign.");
  const double too_much = friction_of(lambda) - mu * lambda[0];
  expect_at_most(
      "|λ_t| - μ λ_n [N s]", "Eq. (14.5)", too_much, close.value, "the cone, apart from " + close.reason,
      too_much < 1e-3 * friction_of(lambda)
          ? "This is slightly more friction than Coulomb's law allows. Does the search for α end after a few "
            "steps, or at a tolerance? Go on until only round-off is left."
          : "This is more friction than Coulomb's law allows.");
  if (q[0] <= 0) return;  // see PartsWhereNothingPresses
  const Vec3 stuck = S.inverse() * q;
  expect_near("final residual of the normal row [m/s]", "Eq. (14.5)", lacks[0], 0, close,
              {{-S.row(0).tail<2>().dot(lambda.tail<2>()), "This λ_n does not include the effect of friction."},
               {S.row(0).tail<2>().dot(stuck.tail<2>() - lambda.tail<2>()),
                "λ_n is still that of sticking. With less friction it changes: solve for both."}},
              "Where it slides the residual of the normal row is 0, too, with the present friction.");
  if (friction_of(lambda) < mu * lambda[0] - close.value) {
    expect_near("residuals of the tangents of a contact inside its cone [m/s]", "Eq. (14.4)",
                lacks.tail<2>().norm(), 0, close, {},
                q.tail<2>().isZero(0)
                    ? "Inside the cone it sticks: the residuals are 0. Here q_t is 0, but λ_t is not: "
                      "by S_tn the normal impulse drives the tangents."
                    : "Inside the cone it sticks: the residuals are 0.");
    return;
  }
  const double across = lacks[1] * lambda[2] - lacks[2] * lambda[1];
  expect_near("residuals of the tangents, across their friction [m²/s² kg]", "Eq. (14.5)", across, 0,
              {close.value * (q.norm() + lambda.norm()), close.reason}, {},
              "Friction is along the remaining slip: (S_tt + α) λ_t = q_t - S_tn λ_n, with one α for both.");
  expect_at_least("α [1/kg]", "Eq. (14.5)",
                  (lacks.tail<2>().dot(lambda.tail<2>()) + close.value) / lambda.tail<2>().squaredNorm(), 0,
                  "friction brakes", "Friction drives it, but has to brake it.");
}

EXERCISE_TEST(SolveOnCone, ObeysCoulombsLaw) {
  Random random;
  Regions regions({"parts", "sticks", "slides", "slides with a friction that lifts",
                   "slides and is pressed down", "no tangential part of q"},
                  10);
  while (regions.lack_draws()) {
    const Mat3 S = coupled_block(random);
    const double mu = random.log_uniform(0.05, 3);
    Vec3 q{random.uniform(-0.3, 1), random.uniform(-2, 2), random.uniform(-2, 2)};
    if (random.integer(0, 4) == 0) q[1] = q[2] = 0;  // a coupled block needs friction even then
    const Vec3 stuck = S.inverse() * q;
    const bool presses = q[0] > 0, sticks = presses && friction_of(stuck) <= mu * stuck[0];
    const bool slides = presses && !sticks;
    const Vec3 lambda = solve_on_cone(S, q, mu);
    regions.draw({{"parts", !presses},
                  {"sticks", sticks},
                  {"slides", slides},
                  {"slides with a friction that lifts", slides && lambda[0] < 0.8 * q[0] / S(0, 0)},
                  {"slides and is pressed down", slides && lambda[0] > 1.2 * q[0] / S(0, 0)},
                  {"no tangential part of q", presses && q[1] == 0 && q[2] == 0}});
    expect_coulomb(S, q, mu, lambda);
  }
}

EXERCISE_TEST(SolveOnCone, ObeysCoulombsLawWhereItNearlyJams) {
  // Blocks that are up to ten thousand times softer in one direction than in another: friction lifts, or presses, a
  // hundredfold.
  Random random;
  Regions regions({"parts", "sticks", "slides", "slides with a friction that lifts", "nearly jams"}, 200);
  while (regions.lack_draws()) {
    const Mat3 R = random.rotation().toRotationMatrix();
    Vec3 values;
    for (double& value : values) value = random.log_uniform(3e-4, 3);
    const Mat3 S = R * values.asDiagonal() * R.transpose();
    const double mu = random.log_uniform(0.05, 3);
    const Vec3 q{random.uniform(-0.3, 1), random.uniform(-2, 2), random.uniform(-2, 2)},
        stuck = S.inverse() * q;
    const bool presses = q[0] > 0, slides = presses && !(friction_of(stuck) <= mu * stuck[0]);
    const Vec3 lambda = solve_on_cone(S, q, mu);
    const double share = lambda[0] / (q[0] / S(0, 0));  // of its value without friction
    regions.draw({{"parts", !presses},
                  {"sticks", presses && !slides},
                  {"slides", slides},
                  {"slides with a friction that lifts", slides && share < 0.4},
                  {"nearly jams", slides && share > 20}});
    expect_coulomb(S, q, mu, lambda);
  }
}

EXERCISE_TEST(SolveOnCone, LooksForTheRootUntilItIsFound) {
  // A nearly singular block and a large μ. For about one μ of twenty, Newton's method starts far from a small root. On
  // the way back each halving is one step.
  const Mat3 S = (Mat3() << 0.12, 0, -0.34, 0, 0.01, 0.02, -0.34, 0.02, 1.01).finished();
  const Vec3 q(1, 5000, 4000);
  for (int k = 0; k < 200 && !::testing::Test::HasFailure(); ++k) {
    const double mu = 20 + 0.05 * k;
    given() = "given S = " + show(S) + " /kg, q = " + show(q) + " m/s, μ = " + show(mu) +
              ", for which a search may take more than 64 steps: it ends where the root is, and not before";
    expect_coulomb(S, q, mu, solve_on_cone(S, q, mu));
  }
}

EXERCISE_TEST(SolveOnCone, SolvesARodOnWhichSweepsCycle) {
  // The rod of (9.8) with ρ = -1.5, dragged at 3 m/s: row by row the update alternates between λ_n and 0, for ever.
  const Mat3 S = (Mat3() << 1.6, -1.2, 0, -1.2, 3.4, 0, 0, 0, 4).finished();
  const double mu = 2, q_n = 0.16, expected = q_n / (1.6 + 1.2 * mu);
  const Vec3 lambda = solve_on_cone(S, Vec3(q_n, -3, 0), mu);
  expect_near("λ_n of a rod that is dragged with μ = 2 [N s]", "Eq. (9.8), (14.5)", lambda[0], expected,
              roundings(100, 1), {{q_n / 1.6, "This is λ_n without friction."}},
              "λ_n = q_n/(S_nn (1 - ρ)): put λ_1 = -μ λ_n into the first row.");
  expect_near("its λ_1 [N s]", "Eq. (14.5)", lambda[1], -mu * expected, roundings(100, 1), {}, "-μ λ_n.");
}

EXERCISE_TEST(SolveOnCone, TurnsWithTheTangents) {
  Random random;
  for (int trial = 0; trial < 20 && !::testing::Test::HasFailure(); ++trial) {
    const Mat3 S = coupled_block(random), R = Eigen::AngleAxisd(random.uniform(0, 6), Vec3::UnitX()).matrix();
    const Vec3 q{random.uniform(0.1, 1), random.uniform(-2, 2), random.uniform(-2, 2)};
    const Vec3 before = solve_on_cone(S, q, 0.5);
    expect_true("λ_n of a contact under pressure is positive", "Eq. (14.5)", before[0] > 0);
    if (before[0] > 10) continue;  // nearly jammed
    expect_near_vector("λ with other tangents [N s]", "Eq. (14.5)",
                       Vec3(solve_on_cone(R * S * R.transpose(), R * q, 0.5)), Vec3(R * before),
                       {1e-9, "round-off, divided by the distance from jamming"}, {},
                       "A cone has the same radius in all directions.");
  }
}

EXERCISE_TEST(SolveOnCone, StaysExactAtAHighSlip) {
  Random random;
  for (const double fast : {1e3, 1e6, 1e9}) {
    const Mat3 S = coupled_block(random);
    const double mu = 0.1;
    const Vec3 lambda = solve_on_cone(S, Vec3(1, -0.6 * fast, 0.8 * fast), mu);
    const Vec3 ahead(1, -0.6 * mu, 0.8 * mu);
    expect_near_vector("λ at a slip of " + show(fast) + " m/s, over λ_n", "Eq. (14.5)",
                       Vec3(lambda / lambda[0]), ahead,
                       {10 / fast + 1e-12, "α is about the slip over the friction, S is 3 at most"}, {},
                       "The faster it slides, the more exactly friction is opposite to the slip.");
    expect_near("residual of the normal row then [m/s]", "Eq. (14.5)", 1 - S.row(0).dot(lambda), 0,
                roundings(1e3, 1 + lambda.norm()), {}, "It is 0, however fast the contact slides.");
  }
}

EXERCISE_TEST(SolveOnCone, KeepsANaN) {
  const Mat3 S = Vec3(1, 2, 2).asDiagonal();
  for (const auto& [q_n, mu] : {std::pair(1.0, 0.5), {-1.0, 0.5}, {1.0, 0.0}})
    for (int k = 0; k < 3; ++k) {
      Vec3 q(q_n, 0.1, 5);
      q[k] = std::nan("");
      expect_true(
          "a q of " + show(q_n) + " with NaN in its entry " + std::to_string(k) + " makes a λ with a NaN",
          "Eq. (14.3)", solve_on_cone(S, q, mu).hasNaN(),
          "The NaN was lost. A q_n of 0 or less gives λ = 0 only if all of q are numbers.");
    }
}

}  // namespace
