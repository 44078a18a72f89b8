// The impulse of one contact: the SPOOK equation of a single row, and the projection.
#include "03_single_contact/single_contact.hpp"
#include "exercise_test.hpp"
#include "regions.hpp"
#include "relative_scales.hpp"

using namespace spook;
using namespace spook::testing;

namespace {

EXERCISE(ContactImpulse, "3.4 contact_impulse");

EXERCISE_TEST(ContactImpulse, SolvesOneRowByHand) {
  const SpookParameters spook{.a = 4, .b = 0.5, .Sigma = 0.25};
  const double nKn = 1.75, gap = -0.05, velocity = -0.9, force = -0.35;
  // B = 4·0.05 + 0.5·0.9 + 0.35 = 0.2 + 0.45 + 0.35 = 1, over 1.75 + 0.25 = 2.
  expect_near(
      "λ [N s] for a = 4, b = 0.5, Σ = 0.25, n·Kn = 1.75, gap = -0.05, G W = -0.9, h G M⁻¹ f = -0.35",
      "Eq. (3.10)", contact_impulse(spook, nKn, gap, velocity, force), 0.5, roundings(8),
      {{0.6 / 2,
        "The sign of the gap: it is negative when penetrating, and -a g then pushes. With +a g it attracts."},
       {0.1 / 2, "The sign of b G W: an approaching contact (G W < 0) needs a larger push."},
       {0.3 / 2, "The sign of the force term: forces that press the bodies together need a larger push."},
       {0.8 / 2, "The gap is missing on the right side."},
       {0.55 / 2, "The velocity G W is missing on the right side."},
       {0.65 / 2, "The force term h G M⁻¹ f is missing: the contact would carry the weight one step late."},
       {1.45 / 2, "The whole velocity has been taken: b G W, not G W."},
       {0.825 / 2, "b multiplies the old velocity only: the force term has no factor."},
       {1 / 1.75, "Σ is missing: divide by n·Kn + Σ."},
       {1 / 1.5, "The sign of Σ: divide by n·Kn + Σ."},
       {1 / 0.25, "n·Kn is missing: divide by n·Kn + Σ."},
       {1 / (1 / 1.75 + 0.25), "This took n·Kn for a mass. It is an inverse mass: divide by n·Kn + Σ."},
       {2, "This multiplied by n·Kn + Σ. It is an inverse mass: divide by it."},
       {1, "This is the right side alone, in m/s. Divide by n·Kn + Σ."},
       {0, "The right side is positive here, so the contact must push: look at its three signs."}},
      "(n·Kn + Σ) λ = -a g - b G W - h G M⁻¹ f.");
  expect_near("the same between two static bodies, n·Kn = 0 [N s]", "Eq. (3.10)",
              contact_impulse(spook, 0, gap, velocity, force), 1 / 0.25, roundings(8),
              {{1 / 1.25,
                "This took n·Kn for 1. Here it is 0, since both bodies are static, and needs no "
                "special case."}},
              "The divisor is Σ alone.");
}

SpookParameters some_parameters(Random& random, double h) {
  const double k = random.log_uniform(1e3, 1e9);
  return spook_parameters(h, k, random.uniform(0, 8));
}

struct Case {
  SpookParameters spook;
  double nKn, gap, velocity, force;

  explicit Case(Random& random)
      : spook(some_parameters(random, random.log_uniform(0.002, 0.03))),
        nKn(random.log_uniform(0.01, 100)),
        gap(random.uniform(-0.01, 0.01)),
        velocity(random.uniform(-1, 1)),
        force(random.uniform(-0.3, 0.3)) {}

  double right_side() const { return -spook.a * gap - spook.b * velocity - force; }
  double size() const { return spook.a * std::abs(gap) + spook.b * std::abs(velocity) + std::abs(force); }
  std::string text() const {
    return "gap = " + show(gap) + " m, G W = " + show(velocity) + " m/s, h G M⁻¹ f = " + show(force) +
           " m/s, right side " + show(right_side()) + " m/s";
  }
};

EXERCISE_TEST(ContactImpulse, NeverPulls) {
  Random random;
  for (int trial = 0; trial < 500 && !::testing::Test::HasFailure(); ++trial) {
    const Case c(random);
    const double lambda = contact_impulse(c.spook, c.nKn, c.gap, c.velocity, c.force);
    const double unprojected = c.right_side() / (c.nKn + c.spook.Sigma);
    expect_at_least("λ [N s] for " + c.text(), "Eq. (3.11)", lambda, 0, "a contact pushes or does nothing",
                    "Without the projection a contact is sticky: it pulls at bodies that separate.");
    if (unprojected < 0)
      expect_near(
          "λ [N s] of a contact that lets go, for " + c.text(), "Eq. (3.11)", lambda, 0, {0, "exact"},
          {{-unprojected, "This is |λ|: it pushes bodies that already separate. Take the larger of λ and 0."}},
          "Where the equation gives λ < 0, the contact lets go: λ = 0. Project the sum of all terms, not each "
          "term by itself.");
  }
}

EXERCISE_TEST(ContactImpulse, SolvesTheRowWheneverItPushes) {
  Random random;
  Regions regions({"open, but closes within the step", "open, and lets go", "deep, and lets go",
                   "opens, but is deep", "pushes for the forces alone"},
                  20);
  while (regions.lack_draws()) {
    const Case c(random);
    const double S = c.nKn + c.spook.Sigma;
    const bool pushes = c.right_side() > 0;
    regions.draw({{"open, but closes within the step", c.gap > 0 && pushes},
                  {"open, and lets go", c.gap > 0 && !pushes},
                  {"deep, and lets go", c.gap < 0 && !pushes},
                  {"opens, but is deep", c.gap < 0 && c.velocity > 0 && pushes},
                  {"pushes for the forces alone", c.gap > 0 && c.velocity > 0 && pushes}});
    const double lambda = contact_impulse(c.spook, c.nKn, c.gap, c.velocity, c.force);
    const std::string let_go =
        c.gap <= 0 && c.velocity <= 0
            ? "A penetrating contact that closes must push."
            : "An open gap may close within this step, and a deep contact that opens slowly "
              "still needs a push. The sign of λ decides, not that of the gap or of G W.";
    expect_near("λ [N s] for " + c.text(), "Eq. (3.7), (3.10)", lambda, pushes ? c.right_side() / S : 0,
                roundings(16, c.size() / S), {{0, let_go}},
                "(n·Kn + Σ) λ = -a g - b G W - h G M⁻¹ f whenever that λ is positive, and 0 elsewhere.");
  }
}

// Bodies that just touch: G W' = (1 - σ b) G W, σ = S/(S + Σ). They end up slower, and do not bounce.
EXERCISE_TEST(ContactImpulse, SlowsBodiesThatMeet) {
  Random random;
  for (int trial = 0; trial < 50 && !::testing::Test::HasFailure(); ++trial) {
    const double S = random.log_uniform(0.01, 100), velocity = random.uniform(-5, -0.1);
    const SpookParameters spook = some_parameters(random, 0.01);
    const double lambda = contact_impulse(spook, S, 0, velocity, 0);
    const double after = velocity + S * lambda;  // G times Eq. (3.12)
    const double sigma = S / (S + spook.Sigma);
    expect_near("G W after two bodies have met at " + show(velocity) + " m/s, gap 0 [m/s]",
                "Eq. (3.10), (3.12)", after, (1 - sigma * spook.b) * velocity, roundings(16, velocity),
                {{velocity, "The contact did nothing."},
                 {(1 + sigma * spook.b) * velocity, "The contact pulled. Look at the sign of b G W."},
                 {(1 - spook.b) * velocity, "Σ is missing: divide by n·Kn + Σ."},
                 {(1 - sigma) * velocity, "b is missing: b G W, not G W."}},
                "The velocity afterwards is 1 - σ b times the velocity before.");
    // The change of kinetic energy is λ times the mean of G W before and after.
    expect_at_most("energy gained by the bodies as they meet [J]", "Eq. (3.12)",
                   lambda * (velocity + after) / 2, 0,
                   "a contact without penetration stores no energy that it "
                   "could release",
                   "They separate faster than they approached.");
  }
}

EXERCISE_TEST(ContactImpulse, KeepsANaN) {
  const SpookParameters spook = {.a = 1, .b = 1, .Sigma = 0};
  expect_true("a gap that is NaN gives a λ that is NaN", "Eq. (3.11)",
              std::isnan(contact_impulse(spook, 1, std::nan(""), 0, 0)),
              "std::max(0.0, NaN) is 0, so a NaN that should warn you becomes λ = 0, a contact that lets go. "
              "std::max(NaN, "
              "0.0), in this order, is NaN.");
}

EXERCISE_TEST(ContactImpulse, DropsNothingSmall) {
  for (const double part :
       relative_scales) {  // the term of the gap is 1 m/s, and that of the velocity cancels nearly all of it
    expect_near("λ of a contact whose terms add up to " + show(part) +
                    " m/s, a difference of two large terms "
                    "[N s]",
                "Eq. (3.10)", contact_impulse({.a = 1, .b = 1, .Sigma = 0}, 1, -1, 1 - part, 0), part,
                roundings(4), {{0, "There is none. " + small_is_dropped}}, small_is_dropped);
    if (::testing::Test::HasFailure()) return;
  }
  for (const double part : relative_scales)  // of the three terms one is large, and another small
    for (int large = 0; large < 3; ++large)
      for (const int more : {1, 2}) {
        double want[3] = {0, 0, 0};
        want[large] = 1, want[(large + more) % 3] = part;
        expect_near("λ of 1 kg, where gap, velocity and force require " + show(want[0]) + ", " + show(want[1]) +
                        " and " + show(want[2]) + " m/s [N s]",
                    "Eq. (3.10)",
                    contact_impulse({.a = 1, .b = 1, .Sigma = 0}, 1, -want[0], -want[1], -want[2]), 1 + part,
                    roundings(4), {{1, "The small one is missing. " + small_is_dropped}}, small_is_dropped);
        if (::testing::Test::HasFailure()) return;
      }
}

}  // namespace
