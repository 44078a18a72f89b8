// A soft substep: its stages by hand, the depth at rest in closed form, and what it leaves of an overlap.
#include <numbers>

#include "exercise_test.hpp"
#include "random_input.hpp"
#include "systems.hpp"

using namespace spook;
using namespace spook::testing;

namespace {

EXERCISE(SoftSubstep, "10.12 soft_substep");

/// ω = 2π f, ζ and h, and the numbers of a soft row in closed form: Eq. (10.20).
struct Spring {
  double h = 1.0 / 240, omega = 2 * std::numbers::pi * 48, zeta = 5;

  double stiffness() const { return h * omega * (2 * zeta + h * omega); }
  SoftParameters soft() const {
    return {.bias_rate = omega / (2 * zeta + h * omega),
            .mass_scale = stiffness() / (1 + stiffness()),
            .impulse_scale = 1 / (1 + stiffness())};
  }
};

/// Balls on each other, from the floor up, and the gaps of their rows.
struct Tower {
  Problem<3> p;
  std::vector<double> gaps;

  Tower(const std::vector<double>& masses, double h, double g = 9.81)
      : p(stack(masses, h, 0, g)), gaps(masses.size(), 0) {}
  std::vector<Twist<3>> step(const Spring& spring) {
    return soft_substep(spring.h, spring.soft(), p.motion.Wf, p.rows, gaps, p.motion.W);
  }
};

EXERCISE_TEST(SoftSubstep, RestsAtTheDepthOfItsFrequency) {
  Random random;
  for (int trial = 0; trial < 20; ++trial) {
    const Spring spring{.h = random.log_uniform(1e-3, 0.02), .omega = random.log_uniform(10, 300), .zeta = 2};
    const double mass = random.log_uniform(0.1, 1000), depth = 9.81 / (spring.omega * spring.omega);
    Tower ball({mass}, spring.h);
    ball.gaps[0] = -depth;
    ball.p.rows[0].lambda = spring.h * mass * 9.81;
    ball.step(spring);
    expect_near(
        "λ/(hmg) of a ball at rest", "Eq. (10.18)", ball.p.rows[0].lambda / (spring.h * mass * 9.81), 1,
        roundings(40), {{2, "λ has been added once more: the sweeps change λ, and the warm start does not."}},
        "At rest the impulse of the substep before is right. Add forces and this impulse to W, then sweep.");
    expect_near("its gap over g/ω²", "Eq. (10.18)", ball.gaps[0] / depth, -1,
                roundings(40, 1 + 9.81 * spring.h * spring.h / depth), {},
                "At rest W is zero between the two sweeps, and gaps do not move.");
    expect_near("its velocity [m/s]", "Eq. (10.15)", ball.p.motion.W[1].z(), 0, roundings(40), {},
                "Between the sweeps and after them a ball at rest does not move.");
  }
}

EXERCISE_TEST(SoftSubstep, SinksByTheWeightAbove) {
  // From touching. Implicit Euler with ζ = 5 loses at least a tenth in 100 substeps, of the slowest mode, too.
  const Spring spring;
  const std::vector<double> masses = {3, 1, 2, 1, 5};
  Tower tower(masses, spring.h);
  for (int n = 0; n < 20000; ++n) tower.step(spring);
  double above = 0;
  for (std::size_t k = masses.size(); k-- > 0;) {
    above += masses[k];
    const double S = 1 / masses[k] + (k > 0 ? 1 / masses[k - 1] : 0);
    const double depth = S * above * 9.81 / (spring.omega * spring.omega);
    expect_near("gap of contact " + std::to_string(k) + " of a tower at rest [m]", "Eq. (10.18)", tower.gaps[k],
                -depth, {1e-10, "what 20000 substeps leave, and roundings"},
                {{0,
                  "Gaps are to follow the motion: g <- g + h G W. W is that between the two sweeps, as the "
                  "second one takes the speed out of an overlap."}},
                "A tower sinks by S F/ω² at each contact, where F is the weight above.");
  }
}

EXERCISE_TEST(SoftSubstep, KeepsNoVelocityOfAnOverlap) {
  // Without weight: u = -σ a g between the sweeps, and 0 after them.
  const Spring spring{.h = 0.01, .omega = 50, .zeta = 1.75};  // a = 12.5/s, σ = 2/3
  Tower ball({2}, spring.h, 0);
  ball.gaps[0] = -0.03;
  const std::vector<Twist<3>> moving = ball.step(spring);
  expect_near("velocity [m/s] with which an overlapping ball moves", "Eq. (10.15), (10.21)", moving[1].z(),
              0.25, roundings(10),
              {{0, "These are the velocities after the second sweep: return those between the two."}},
              "It is that between the two sweeps.");
  expect_near("its gap afterwards [m]", "Eq. (10.19)", ball.gaps[0], -0.0275, roundings(10, 0.03),
              {{-0.03, "The gap moves with the velocity between the two sweeps."},
               {-0.0325, "The gap moves by +h G W: a velocity that opens it is positive."},
               {0.22, "h is missing: the gap moves by h G W."}});
  expect_near(
      "the velocity that it keeps [m/s]", "Eq. (10.15)", ball.p.motion.W[1].z(), 0, roundings(10),
      {{0.25, "The second sweep is missing, or it is soft. It is to be rigid: a = 0, and scales 1 and 0."}});
  expect_near("λ that it keeps [N s]", "Eq. (10.15)", ball.p.rows[0].lambda, 0, roundings(10), {},
              "The second sweep takes the impulse of the first one back.");
}

EXERCISE_TEST(SoftSubstep, StopsAFastBallAtTheFloor) {
  const Spring spring{.h = 0.0078125, .omega = 50, .zeta = 1};
  Tower ball({2}, spring.h);
  ball.gaps[0] = 0.015625;
  ball.p.motion.W[1].z() = -40;
  const std::vector<Twist<3>> moving = ball.step(spring);
  expect_near("velocity [m/s] of a ball that would pass through the floor", "Eq. (10.21)", moving[1].z(), -2,
              roundings(10, 40), {}, "An open gap may close within the substep, and no more.");
  expect_near("its gap afterwards [m]", "Eq. (10.19)", ball.gaps[0], 0, roundings(10, 40 * spring.h), {},
              "It closes the gap in this substep.");
  expect_near("velocity that it keeps [m/s]", "Eq. (10.15)", ball.p.motion.W[1].z(), 0, roundings(20, 40),
              {{-2, "The second sweep has the gap of before the motion: move the gaps first."}});
}

/// The same substep by chapter 04's rows, with some stages left out or in another place.
struct ByHand {
  bool forces_last = false, cold = false, forgets_lambda = false, late_gaps = false, gap_of_before = false;
  bool warm_contacts_only = false, gaps_of_pushing_only = false;

  void step(double h, double a, double softness, Problem<6>& p, std::vector<double>& gaps) const {
    std::vector<Twist<6>>& W = p.motion.W;
    const std::vector<double> old = gaps;
    const auto add_forces = [&] {
      for (std::size_t i = 0; i < W.size(); ++i) W[i] += p.motion.Wf[i];
    };
    const auto sweep_rows = [&](bool soft, const std::vector<double>& at) {
      for (std::size_t k = 0; k < p.rows.size(); ++k) {
        Row<6> row = p.rows[k];
        const double S = row.Gi.dot(row.MinvGi) + row.Gj.dot(row.MinvGj);
        const bool open = row.lo == 0 && at[k] > 0;
        row.B = open ? -at[k] / h : soft ? -a * at[k] : 0;
        row.Sigma = open || !soft ? 0 : softness * S;
        row.diagonal = S + row.Sigma;
        update_row(row, W);
        p.rows[k].lambda = row.lambda;
      }
    };
    const auto move_gaps = [&] {
      for (std::size_t k = 0; k < gaps.size(); ++k)
        if (p.rows[k].lambda != 0 || !gaps_of_pushing_only)
          gaps[k] += h * (p.rows[k].Gi.dot(W[static_cast<std::size_t>(p.rows[k].i)]) +
                          p.rows[k].Gj.dot(W[static_cast<std::size_t>(p.rows[k].j)]));
    };
    if (!forces_last) add_forces();
    for (Row<6>& row : p.rows) {
      if (forgets_lambda) row.lambda = 0;
      if (!cold && (row.lo == 0 || !warm_contacts_only)) apply_impulse(row, row.lambda, W);
    }
    sweep_rows(true, gaps);
    if (!late_gaps) move_gaps();
    sweep_rows(false, gap_of_before ? old : gaps);
    if (late_gaps) move_gaps();
    if (forces_last) add_forces();
  }
};

EXERCISE_TEST(SoftSubstep, HasItsStagesInTheirOrder) {
  Random random;
  for (int trial = 0; trial < 10 && !::testing::Test::HasFailure(); ++trial) {
    const int count = trial == 0 ? many : 8;
    Problem<6> start = random_problem(random, count / 2, count);
    give_bounds(random, start);
    const double h = 0.02, a = 5, softness = random.log_uniform(0.1, 3);
    std::vector<double> gaps;
    for (Row<6>& row : start.rows) {
      row.lambda = std::clamp(random.uniform(-0.1, 0.2), row.lo, row.hi);
      gaps.push_back(random.uniform(-0.02, 0.01));
    }
    const auto by_hand = [&](const ByHand& way) {
      Problem<6> p = start;
      std::vector<double> after = gaps;
      way.step(h, a, softness, p, after);
      return std::pair(lambdas(p), as_eigen(after));
    };
    const auto [expected, expected_gaps] = by_hand({});
    Problem<6> p = start;
    std::vector<double> after = gaps;
    soft_substep(h,
                 {.bias_rate = a, .mass_scale = 1 / (1 + softness), .impulse_scale = softness / (1 + softness)},
                 p.motion.Wf, p.rows, after, p.motion.W);
    // Each update rounds numbers of about 10, and the later ones carry that on.
    const Tolerance tolerance = roundings(1e4 * count, 10);
    expect_near_vector(
        "gaps of " + std::to_string(count) + " rows [m]", "Eq. (10.19)", as_eigen(after), expected_gaps,
        tolerance,
        {{as_eigen(gaps), "Gaps have not moved."},
         {by_hand({.late_gaps = true}).second,
          "The gaps have moved too late: move them between the two sweeps."},
         {by_hand({.forces_last = true}).second, "The forces came last: add them before the sweeps."},
         {by_hand({.gaps_of_pushing_only = true}).second,
          "Gaps of rows without an impulse have not moved. All gaps move with the bodies."},
         {by_hand({.warm_contacts_only = true}).second,
          "W has the old λ of contacts only. Every row adds its own: joints and friction, too."},
         {by_hand({.cold = true}).second, "W lacks the λ of the last substep: add M⁻¹ Gᵀ λ."},
         {by_hand({.forgets_lambda = true}).second,
          "Begin with the λ of the last substep, not with 0. And W has the λ of all rows before "
          "the first row is updated."}},
        "g <- g + h G W, with W after the soft sweep. " + ends_early);
    expect_near_vector(
        "λ of " + std::to_string(count) + " rows [N s]", "Eq. (10.15), (10.21)", lambdas(p), expected,
        tolerance,
        {{by_hand({.gap_of_before = true}).first, "The second sweep is to know the gaps after the motion."}},
        "The second sweep is rigid, and begins from the λ and W of the first. It updates all rows, those "
        "without an impulse, too. " +
            ends_early);
  }
}

EXERCISE_TEST(SoftSubstep, RefusesWhatItCannotStep) {
  Tower ball({1, 2}, 0.01);
  const auto state = [&] {
    std::vector<double> all = ball.gaps;
    for (const Row<3>& row : ball.p.rows) all.push_back(row.lambda);
    for (const Twist<3>& velocity : ball.p.motion.W) all.insert(all.end(), velocity.begin(), velocity.end());
    return all;
  };
  for (const double h : {0.0, -0.01, std::nan(""), infinity})
    expect_rejects(
        "soft_substep(h = " + show(h) + ")", "h",
        [&] { soft_substep(h, {}, ball.p.motion.Wf, ball.p.rows, ball.gaps, ball.p.motion.W); },
        "A substep takes time.", state);
  ball.gaps.pop_back();
  expect_rejects(
      "soft_substep(gaps: 1, rows: 2)", "gaps",
      [&] { soft_substep(0.01, {}, ball.p.motion.Wf, ball.p.rows, ball.gaps, ball.p.motion.W); },
      "Each row has a gap.", state);
}

}  // namespace
