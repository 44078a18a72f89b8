// The three numbers a, b, Σ: closed forms, the relations between them, and the decay of a violation.
#include "03_single_contact/single_contact.hpp"
#include "exercise_test.hpp"

using namespace spook;
using namespace spook::testing;

namespace {

EXERCISE(SpookParameters, "3.1 spook_parameters");

// d is never 1/4 or 1, so that no two of the known mistakes give the same number. Computing 1/(1 + 4d) as 1 - b
// is allowed. It loses 1 + 4d roundings, for which `count` allows.
struct Input {
  Random random;
  double h = random.log_uniform(0.001, 0.03);
  double k = random.log_uniform(1e2, 1e10);
  double d = random.uniform(2, 8);
  double upsilon = 1 / (1 + 4 * d);
  double count = 8 * (1 + 4 * d);
  std::string text = "h = " + show(h) + " s, k = " + show(k) + " N/m, d = " + show(d);
};

const std::string lost_one = "This has 1/(4d) where 1/(1 + 4d) belongs: at d = 0 it would divide by zero.";
const std::string d_is_time =
    "This has d/h where d belongs: d counts steps, not seconds, so h has no part in 1 + 4d.";
const std::string d_in_seconds = "This has h d where d belongs: d counts steps already, and has no unit.";
const std::string lost_four = "This has 1 + d where 1 + 4d belongs.";

EXERCISE_TEST(SpookParameters, WeighTheGapByA) {
  const Input in;
  const double h = in.h, d = in.d, a = 4 * in.upsilon / h;
  const double got = spook_parameters(h, in.k, d).a;
  expect_near("a [1/s] for " + in.text, "Eq. (3.4)", got, a, roundings(in.count, a),
              {{a / h, "This divides by h²: one h too many. a times a gap must be a velocity, so a is in 1/s."},
               {a * h, "h is missing: a times a gap [m] must be a velocity [m/s], so a is in 1/s."},
               {a * h * h, "This is 4h/(1 + 4d): h belongs in the denominator. a is in 1/s."},
               {4 / h,
                "This is 4/h: the 1 + 4d is missing. A violation should decay in about d steps, not in "
                "one."},
               {1 / (h * (1 + 4 * d)), "The 4 in the numerator is missing."},
               {1 / (h * d), lost_one},
               {4 / (h * (1 + 4 * d / h)), d_is_time},
               {4 / (h * (1 + 4 * d * h)), d_in_seconds},
               {4 / (h * (1 + d)), lost_four}},
              "Eq. (3.4): a = 4/(h (1 + 4d)).");
}

EXERCISE_TEST(SpookParameters, WeighTheVelocityByB) {
  const Input in;
  const double d = in.d, b = 4 * d * in.upsilon;
  const double got = spook_parameters(in.h, in.k, d).b;
  expect_near("b for " + in.text, "Eq. (3.5)", got, b, roundings(8),
              {{1, "This is b = 1. Eq. (3.5) leaves 1/(1 + 4d) of the velocity to the next step."},
               {in.upsilon,
                "This is 1/(1 + 4d), the share of the velocity that stays. b is the share that is removed."},
               {4 * d, "This is 4d: the denominator 1 + 4d is missing. b lies between 0 and 1."},
               {d * in.upsilon, "The 4 in the numerator is missing."},
               {4 * d / in.h / (1 + 4 * d / in.h), d_is_time},
               {4 * d * in.h / (1 + 4 * d * in.h), d_in_seconds},
               {d / (1 + d), "This has d/(1 + d) where 4d/(1 + 4d) belongs."}},
              "Eq. (3.5): b = 4d/(1 + 4d).");
}

EXERCISE_TEST(SpookParameters, SoftenByStiffnessAndStep) {
  const Input in;
  const double h = in.h, k = in.k, d = in.d, Sigma = 4 * in.upsilon / (h * h * k);
  const double got = spook_parameters(h, k, d).Sigma;
  expect_near(
      "Σ [1/kg] for " + in.text, "Eq. (3.6)", got, Sigma, roundings(in.count, Sigma),
      {{1 / k, "This is 1/k, a compliance [m/N]. Σ stands beside an inverse mass: Eq. (3.6) makes it one."},
       {Sigma * h, "One h too few: Σ stands beside an inverse mass, so it contains 1/(h² k)."},
       {Sigma * h * h, "h² is missing: Σ stands beside an inverse mass [1/kg], and 1/k is in m/N."},
       {Sigma / h, "One h too many: Σ stands beside an inverse mass, so it contains 1/(h² k)."},
       {Sigma * k * k, "k belongs in the denominator: a stiffer contact has a smaller Σ."},
       {4 / (h * h * k), "The 1 + 4d is missing."},
       {in.upsilon / (h * h * k), "The 4 in the numerator is missing."},
       {1 / (h * h * k * d), lost_one},
       {4 / (h * h * k * (1 + 4 * d / h)), d_is_time},
       {4 / (h * h * k * (1 + 4 * d * h)), d_in_seconds},
       {4 / (h * h * k * (1 + d)), lost_four}},
      "Eq. (3.6): Σ = 4/(h² k (1 + 4d)).");
}

EXERCISE_TEST(SpookParameters, SatisfyTheirRelations) {
  Random random;
  for (int trial = 0; trial < 50 && !::testing::Test::HasFailure(); ++trial) {
    const double h = random.log_uniform(1e-4, 0.1), k = random.log_uniform(1, 1e12);
    const double d = random.log_uniform(0.01, 100), upsilon = 1 / (1 + 4 * d);
    const auto [a, b, Sigma] = spook_parameters(h, k, d);
    expect_near("a h for d = " + show(d), "Eq. (3.4)", a * h, 4 * upsilon, roundings(8), {},
                "a h = 4/(1 + 4d) depends on d alone.");
    expect_near("1 - b for d = " + show(d), "Eq. (3.4), (3.5)", 1 - b, a * h / 4, roundings(4), {},
                "1 - b = 1/(1 + 4d) = a h/4, for any h and k.");
    expect_near("Σ h k over a, for d = " + show(d), "Eq. (3.4), (3.6)", Sigma * h * k / a, 1,
                roundings(16 / upsilon), {},
                "Σ = a/(h k), for any d. With it, a weight rests at a depth of mg/k: Eq. (3.13).");
  }
}

EXERCISE_TEST(SpookParameters, FollowTheUnitsOfTheStep) {
  const Input in;
  const SpookParameters whole = spook_parameters(in.h, in.k, in.d),
                        half = spook_parameters(in.h / 2, in.k, in.d);
  expect_near("a at h/2 over a at h", "Eq. (3.4)", half.a / whole.a, 2, roundings(2 * in.count, 2),
              {{4, d_is_time}}, "a is in 1/s, so half the step gives twice the number.");
  expect_near("b at h/2 minus b at h", "Eq. (3.5)", half.b - whole.b, 0, roundings(4), {},
              "b has no unit, so it must not depend on h. d counts steps, not seconds.");
  expect_near("Σ at h/2 over Σ at h", "Eq. (3.6)", half.Sigma / whole.Sigma, 4, roundings(2 * in.count, 4),
              {{2, "One h too few."}, {1, "h is missing."}, {8, "One h too many."}},
              "With k in N/m = kg/s², 1/(h² k) is in 1/kg, so half the step gives four times the number.");
}

EXERCISE_TEST(SpookParameters, NeedNoRelaxation) {
  const double h = 0.01, k = 1e4;
  const SpookParameters got = spook_parameters(h, k, 0);
  expect_near("a for d = 0 [1/s]", "Eq. (3.4)", got.a, 4 / h, roundings(8, 4 / h), {},
              "d = 0 is allowed: 1 + 4d is then 1, and a = 4/h.");
  expect_near("b for d = 0", "Eq. (3.5)", got.b, 0, roundings(4), {}, "b = 4d/(1 + 4d) is 0 for d = 0.");
  expect_near("Σ for d = 0 [1/kg]", "Eq. (3.6)", got.Sigma, 4 / (h * h * k), roundings(8, 4 / (h * h * k)), {},
              "d = 0 is allowed: 1 + 4d is then 1, and Σ = 4/(h² k).");
}

EXERCISE_TEST(SpookParameters, TakeAnyRelaxation) {
  const double h = 0.01, k = 1e4;
  for (const double d : {1e-12, 1e-8, 1e-4, 1.0, 1e4, 1e8, 1e12}) {
    const auto [a, b, Sigma] = spook_parameters(h, k, d);
    const double upsilon = 1 / (1 + 4 * d), count = 8 * (1 + 4 * d);
    const std::string of = " for d = " + show(d);
    const std::string clue = "This small d has been treated as 0. d may be any number from 0 on.";
    expect_near("a h" + of, "Eq. (3.4)", a * h, 4 * upsilon, roundings(count, upsilon), {{0, clue}}, clue);
    expect_near("b" + of, "Eq. (3.5)", b, 4 * d * upsilon, roundings(8, 4 * d * upsilon), {{0, clue}}, clue);
    expect_near("Σ h² k" + of, "Eq. (3.6)", Sigma * h * h * k, 4 * upsilon, roundings(count, upsilon),
                {{0, clue}}, clue);
    if (::testing::Test::HasFailure()) return;
  }
}

// A violation y without forces and without bounds on λ: v <- v - σ (a y + b v), y <- y + h v, σ = S/(S + Σ).
EXERCISE_TEST(SpookParameters, LetAViolationDecayAtTheRateOfD) {
  const double h = 1.0 / 60, k = 1e12, inverse_mass = 1;
  for (const double d : {3.0, 4.0, 5.0, 10.0}) {
    const auto [a, b, Sigma] = spook_parameters(h, k, d);
    const double sigma = inverse_mass / (inverse_mass + Sigma);
    double y = 1, v = 0, before = 0;
    for (int n = 0; n < 20; ++n) {
      before = y;
      v -= sigma * (a * y + b * v);
      y += h * v;
    }
    // The roots of Eq. (3.14) for σ = 1; the smaller one has died out by (0.118/0.651)^20 = 1e-15 at the latest.
    const double root = (2 * d - 1 + 2 * std::sqrt(d * (d - 2))) / (1 + 4 * d);
    expect_near("fraction of a violation that remains after a step, d = " + show(d) + ", k = 1e12 N/m",
                "Eq. (3.14)", y / before, root,
                {1e-8, "4Υ m/(h² k) < 2e-9, how far σ is from 1, and roundings"}, {},
                "For Σ -> 0 it is 0.651 for d = 3, 0.745 for d = 4, 0.797 for d = 5, 0.900 for d = 10.");
  }
}

EXERCISE_TEST(SpookParameters, RejectAStepThatIsNotPositive) {
  spook_parameters(0.01, 1e4, 3);
  for (const double h : {0.0, -0.01, std::nan(""), HUGE_VAL})
    expect_rejects(
        "h = " + show(h), "h", [&] { spook_parameters(h, 1e4, 3); }, "See require_positive in require.hpp.");
}

EXERCISE_TEST(SpookParameters, RejectAStiffnessThatIsNotPositive) {
  spook_parameters(0.01, 1e4, 3);
  for (const double k : {0.0, -1e4, std::nan(""), HUGE_VAL})
    expect_rejects(
        "k = " + show(k), "k", [&] { spook_parameters(0.01, k, 3); }, "See require_positive in require.hpp.");
}

EXERCISE_TEST(SpookParameters, RejectANegativeRelaxation) {
  spook_parameters(0.01, 1e4, 3);
  for (const double d : {-0.1, -3.0, std::nan(""), HUGE_VAL})
    expect_rejects(
        "d = " + show(d), "d", [&] { spook_parameters(0.01, 1e4, d); },
        "See require_not_negative in require.hpp. d = 0 is allowed.");
  const std::string clue = "Check h and k before you return, also where d = 0.";
  expect_rejects(
      "h = 0 where d = 0", "h", [&] { spook_parameters(0, 1e4, 0); }, clue);
  expect_rejects(
      "k = NaN where d = 0", "k", [&] { spook_parameters(0.01, std::nan(""), 0); }, clue);
}

}  // namespace
