// The row of a limit: its side, its direction, and when it acts.
#include "exercise_test.hpp"
#include "frames.hpp"
#include "regions.hpp"

using namespace spook;
using namespace spook::testing;

namespace {

EXERCISE(LimitConstraint, "13.4 limit_constraint");

constexpr double limit_step = 0.01;
const SpookParameters numbers{.a = 30, .b = 0.9, .Sigma = 0.02};
const JointLimits narrow{.lower = -0.5, .upper = 2};

Coordinate at(double value) {
  return {.i = 3,
          .j = 1,
          .Gi = velocity_of(Vec3(1, 2, 3), Vec3(4, 5, 6)),
          .Gj = velocity_of(Vec3(-1, 0, 2), Vec3(0.5, 7, 1)),
          .value = value};
}

Constraint<6> row_at(double value) {
  return limit_constraint(at(value), narrow, numbers, limit_step);
}

EXERCISE_TEST(LimitConstraint, HasTheGapToTheNearerLimit) {
  struct Case {
    double value, gap;
    const char* where;
  };
  for (const Case& c : {Case{-0.3, 0.2, "above the lower limit"}, Case{-0.7, -0.2, "below the lower limit"},
                        Case{1.9, 0.1, "below the upper limit"}, Case{2.3, -0.3, "above the upper limit"}})
    expect_near("gap of a coordinate at " + show(c.value) + ", " + c.where + " (from -0.5 to 2)", "Eq. (13.10)",
                row_at(c.value).gap, c.gap, roundings(16, 2),
                {{-c.gap, "The sign: the gap is positive within the limits, negative beyond."},
                 {c.value - narrow.lower, "This is the gap to the lower limit. The upper one is nearer."},
                 {narrow.upper - c.value, "This is the gap to the upper limit. The lower one is nearer."},
                 {c.value, "This is the coordinate itself. The gap is its distance to the limit."},
                 {0, "Beyond the limit the gap is negative: with 0 nothing would bring it back."}},
                "The gap is s - lower to the lower limit, and upper - s to the upper one. Take the smaller of "
                "the two.");
}

EXERCISE_TEST(LimitConstraint, PushesBackFromEither) {
  for (const double value : {-0.4, -0.6, 1.8, 2.1}) {
    const bool low = value < 0.75;
    const Constraint<6> row = row_at(value);
    const Coordinate free = at(value);
    const double sign = low ? 1 : -1;
    const std::string of = std::string(" at the ") + (low ? "lower" : "upper") + " limit";
    const std::string clue =
        low ? "At the lower limit the gap grows with the coordinate."
            : "At the upper limit the gap falls as the coordinate grows: both blocks change their sign.";
    expect_near_vector("Gj" + of, "Eq. (13.10)", row.Gj, Twist<6>(sign * free.Gj), {0, "exact"}, {}, clue);
    expect_near_vector("Gi" + of, "Eq. (13.10)", row.Gi, Twist<6>(sign * free.Gi), {0, "exact"}, {}, clue);
    expect_true("the row" + of + " has lo = 0 and hi = ∞; here lo = " + show(row.lo) + ", hi = " + show(row.hi),
                "Eq. (13.10)", row.lo == 0 && row.hi == infinity,
                row.lo < 0 ? "It also pulls this way: a limit acts like a contact, which only pushes."
                           : "λ only pushes: 0 <= λ < ∞.");
    expect_true("the row" + of + " is between bodies 3 and 1; here " + show(row.i) + " and " + show(row.j),
                "Eq. (13.10)", row.i == 3 && row.j == 1, "Copy the bodies of the coordinate's row.");
  }
  for (const double value : {4.5, 5.0, 5.5}) {
    const Constraint<6> row = limit_constraint(at(value), {.lower = 5, .upper = 5}, numbers, limit_step);
    expect_true(
        "the row at " + show(value) + " between equal limits of 5 has lo = 0 and hi = ∞; here lo = " +
            show(row.lo) + ", hi = " + show(row.hi),
        "Eq. (13.10)", row.lo == 0 && row.hi == infinity,
        "Equal limits make no other row: it only pushes, λ >= 0, away from the limit with the smaller gap.");
  }
}

EXERCISE_TEST(LimitConstraint, AllowsMotionUpToTheLimit) {
  for (const double value : {-0.4, 1.0, 1.99}) {
    const SpookParameters got = row_at(value).spook;
    expect_near(
        "a, before the limit [1/s]", "Eq. (13.11)", got.a, 1 / limit_step, roundings(2, 1 / limit_step),
        {{numbers.a,
          "This is SPOOK's a. It brakes a coordinate that is still on its way: the limit would act too early."},
         {0, "Without a it stops at once, before the limit."},
         {1, "It is 1/h: a step may use up the gap, g + h dg/dt >= 0."}},
        "g + h dg/dt >= 0 requires dg/dt >= -g/h: a = 1/h.");
    expect_near("b, before the limit", "Eq. (13.11)", got.b, 1, {0, "exact"},
                {{numbers.b, "This is SPOOK's b: it leaves 1 - b of the speed, which leads beyond the limit."}},
                "The whole speed counts: b = 1.");
    expect_near("Σ, before the limit", "Eq. (3.6)", got.Sigma, numbers.Sigma, {0, "a copy"}, {}, "Copy Σ.");
  }
}

EXERCISE_TEST(LimitConstraint, IsASpringBeyondIt) {
  for (const double value : {-0.6, 2.2, -0.5}) {  // at the limit, too
    const SpookParameters got = row_at(value).spook;
    const double got_gap = row_at(value).gap;
    expect_near(
        "a, beyond the limit or at it [1/s]", "Eq. (13.11)", got.a, numbers.a, {0, "a copy"},
        {{1 / limit_step,
          got_gap == 0 ? "This is 1/h. At the limit the gap is 0, and Eq. (13.11) has 1/h for g > 0 only."
                       : "This is 1/h: it would bring back the whole gap in one step, and throw it off."}},
        "Beyond the limit a is that of SPOOK.");
    expect_near("b, beyond the limit or at it", "Eq. (13.11)", got.b, 1, {0, "exact"},
                {{numbers.b, "SPOOK's b leaves 1 - b of the speed on arrival, which leads beyond the limit."}},
                "Stop it in one step on arrival: b = 1.");
    expect_near("Σ, beyond the limit or at it", "Eq. (3.6)", got.Sigma, numbers.Sigma, {0, "a copy"}, {},
                "Copy Σ.");
  }
}

EXERCISE_TEST(LimitConstraint, MayHaveOneLimitOnly) {
  const Constraint<6> low = limit_constraint(at(7), {.lower = 5}, numbers, limit_step),
                      high = limit_constraint(at(7), {.upper = 5}, numbers, limit_step);
  expect_near("gap above a lower limit, without an upper one", "Eq. (13.10)", low.gap, 2, roundings(16, 7), {},
              "An infinite limit is infinitely far away, and never the nearer one.");
  expect_near("gap beyond an upper limit, without a lower one", "Eq. (13.10)", high.gap, -2, roundings(16, 7),
              {}, "An infinite limit is infinitely far away, and never the nearer one.");
}

EXERCISE_TEST(LimitConstraint, UsesTheNearerLimitEverywhere) {
  Random random;
  Regions regions({"nearer the lower one", "nearer the upper one", "below the lower one", "above the upper one",
                   "only a lower one", "only an upper one", "at a limit", "below both, which are equal",
                   "above both, which are equal", "nearer the lower one, which is at 0",
                   "nearer the upper one, which is at 0"},
                  5);
  while (regions.lack_draws()) {
    const int kind = random.integer(0, 5), zero = random.integer(0, 3);
    const double room = kind == 4 ? 0 : random.uniform(0.5, 3);
    const double lower = zero == 0 ? 0 : zero == 1 ? -room : random.uniform(-3, 3), upper = lower + room;
    const JointLimits some{.lower = kind == 0 ? -infinity : lower, .upper = kind == 1 ? infinity : upper};
    const double value = kind == 2 ? lower : kind == 3 ? upper : random.uniform(lower - 1, upper + 1);
    const double above = value - some.lower, below = some.upper - value, gap = std::min(above, below);
    regions.draw({{"nearer the lower one", above > 0 && above < below},
                  {"nearer the upper one", below > 0 && below < above},
                  {"below the lower one", above < 0},
                  {"above the upper one", below < 0},
                  {"only a lower one", kind == 1},
                  {"only an upper one", kind == 0},
                  {"at a limit", gap == 0},
                  {"below both, which are equal", kind == 4 && above < 0},
                  {"above both, which are equal", kind == 4 && below < 0},
                  {"nearer the lower one, which is at 0", above < below && some.lower == 0},
                  {"nearer the upper one, which is at 0", below < above && some.upper == 0}});
    const Constraint<6> row = limit_constraint(at(value), some, numbers, limit_step);
    const std::string where =
        " of a coordinate at " + show(value) + ", between " + show(some.lower) + " and " + show(some.upper);
    expect_near("gap" + where, "Eq. (13.10)", row.gap, gap, roundings(4, 8), {},
                "Above the lower limit the gap is s - lower, below the upper one upper - s. Take the smaller "
                "of the two, with its sign: one that is passed is negative, and so it is the smaller one.");
    expect_near_vector("Gj" + where, "Eq. (13.10)", row.Gj, Twist<6>((above < below ? 1 : -1) * at(value).Gj),
                       {0, "exact"}, {}, "Use the sign of the row whose gap you take.");
    expect_near("a" + where + " [1/s]", "Eq. (13.11)", row.spook.a, gap > 0 ? 1 / limit_step : numbers.a,
                roundings(2, 100), {}, "Use 1/h before the limit, and SPOOK's a beyond it.");
    expect_near("b" + where, "Eq. (13.11)", row.spook.b, 1, {0, "exact"}, {},
                "Use b = 1 before the limit and beyond it.");
  }
}

// A wheel turns towards its limit, computed by hand: one row, solved exactly in every step.
EXERCISE_TEST(LimitConstraint, StopsAWheelWhereItShould) {
  const double I = 2, limit = 0.237;
  const SpookParameters spook = spook_parameters(limit_step, 1e9, 3);
  double angle = 0, omega = 1.3, farthest = 0, given = 0;
  for (int n = 1; n <= 60; ++n) {
    const Coordinate free{
        .i = 0, .j = 1, .Gi = Twist<6>::Zero(), .Gj = velocity_of(Vec3::Zero(), Vec3::UnitZ()), .value = angle};
    const Constraint<6> row = limit_constraint(free, {.upper = limit}, spook, limit_step);
    const double G = row.Gj[5];
    const double B = -row.spook.a * row.gap - row.spook.b * G * omega;
    const double lambda = std::clamp(B / (G * G / I + row.spook.Sigma), row.lo, row.hi);
    omega += G * lambda / I;
    angle += limit_step * omega;
    given -= G * lambda;
    farthest = std::max(farthest, angle);
    if (n * limit_step * 1.3 < limit - limit_step * 1.3)
      expect_near("angle on the way, after " + show(n * limit_step) + " s [rad]", "Eq. (13.11)", angle,
                  n * limit_step * 1.3, roundings(64), {}, "Nothing slows it before the step of its arrival.");
    if (::testing::Test::HasFailure()) return;
  }
  expect_near("the largest angle [rad]", "Eq. (13.11)", farthest, limit, {1e-6, "h Σ I ω is below 1e-6"}, {},
              "If it arrives within a step it is stopped at the limit, not beyond.");
  expect_near("angle at the end [rad]", "Eq. (13.11)", angle, limit, {1e-6, "h Σ I ω is below 1e-6"}, {},
              "It stays there: a limit does not throw it back.");
  expect_near("total impulse of the limit [N m s]", "Eq. (13.10)", given, I * 1.3, {1e-4, "Σ of 1e-5 of it"},
              {}, "The limit took all of I ω.");
}

}  // namespace
