// The largest friction impulse of a step: the product, and the slopes and distances that follow from it.
#include "exercise_test.hpp"
#include "sliding.hpp"

using namespace spook;
using namespace spook::testing;

namespace {

EXERCISE(FrictionBound, "5.4 friction_bound");

const std::string not_an_impulse =
    "h is missing: this is a force [N], as in the notes. λ is an impulse [N s]. At 60 steps a second friction "
    "would be 60 times too strong.";

EXERCISE_TEST(FrictionBound, IsTheFrictionForceOfAStep) {
  expect_near("Λ [N s] for μ = 0.4, m = 3 kg, g_n = 10 m/s², h = 0.02 s", "Eq. (5.7)",
              friction_bound(0.4, 3, 10, 0.02), 0.24, roundings(8, 0.24),
              {{12, not_an_impulse},
               {0.6, "μ is missing: this is the normal impulse m g_n h."},
               {0.08, "The mass is missing."},
               {0.024, "Gravity is missing."},
               {0.4 * 3 * 9.81 * 0.02, "This contains 9.81 m/s². Use the argument, gravity along the normal."},
               {0.0048, "h² is one h too many: a force times h is an impulse."},
               {600, "This has been divided by h: a force times h is an impulse."},
               {0.4 / 3 * 10 * 0.02, "This has been divided by the mass. The argument is the mass, not 1/m."},
               {0.12, "This is half the bound: the box reaches from -Λ to Λ."},
               {0.48, "This is twice the bound: the box reaches from -Λ to Λ."}},
              "Λ = μ m g_n h.");
}

EXERCISE_TEST(FrictionBound, IsProportionalToEach) {
  Random random;
  for (int trial = 0; trial < 50 && !::testing::Test::HasFailure(); ++trial) {
    const double mu = random.uniform(0, 3), m = random.log_uniform(1e-3, 1e3), g_n = random.uniform(0, 30);
    const double h = random.log_uniform(1e-4, 0.1), force = mu * m * g_n;
    expect_near(
        "Λ [N s] for μ = " + show(mu) + ", m = " + show(m) + " kg, g_n = " + show(g_n) +
            " m/s², h = " + show(h) + " s",
        "Eq. (5.7)", friction_bound(mu, m, g_n, h), force * h, roundings(8, force * h),
        {{force, not_an_impulse}, {m * g_n * h, "μ is missing, or has been kept below 1: it may be more."}},
        "Λ = μ m g_n h, and nothing else: μ may be larger than 1, g_n larger or smaller than 9.81.");
  }
}

EXERCISE_TEST(FrictionBound, IsAnImpulse) {
  const double whole = friction_bound(0.5, 2, 9.81, 1.0 / 60), half = friction_bound(0.5, 2, 9.81, 1.0 / 120);
  expect_near("Λ at h/2 over Λ at h", "Eq. (5.7)", half / whole, 0.5, roundings(8),
              {{1, not_an_impulse}, {0.25, "h² is one h too many."}, {2, "h belongs in the numerator."}},
              "Half the step, half the impulse: two steps of h/2 brake as much as one of h.");
}

// A block on a slope, let go: gravity pulls along t1 by g sin θ, and has g cos θ left along the normal.
struct Slope {
  double theta, h, mu;
  double m = 2, g = 9.81;
  double g_n() const { return g * std::cos(theta); }
  double pull() const { return g * std::sin(theta); }
  double bound() const { return friction_bound(mu, m, g_n(), h); }
  std::string text() const {
    return "θ = " + show(theta) + ", μ = " + show(mu) + " (tan θ = " + show(std::tan(theta)) +
           "), h = " + show(h) + " s";
  }
};

// Its speed down the slope after that many steps. One direction is enough: box and cone agree on it.
double speed_after(int steps, const Slope& slope, const Tangents& t) {
  const double bound = slope.bound();
  const Mat3 K = Mat3::Identity() / slope.m;
  Vec3 v = Vec3::Zero();
  for (int n = 0; n < steps; ++n) {
    v += slope.h * slope.pull() * t.t1;
    v += friction_impulse(K, v, t, 0, bound) / slope.m;
  }
  return v.dot(t.t1);
}

EXERCISE_TEST(FrictionBound, HoldsABlockUpToTanTheta) {
  Random random;
  for (const double h : {1.0 / 60, 1.0 / 1000})
    for (const double theta : {0.1, 0.5, 1.0, 1.3}) {
      const Tangents t = random_tangents(random);
      const double tangent = std::tan(theta);
      const Slope above{theta, h, tangent * (1 + 1e-9)}, below{theta, h, tangent * (1 - 1e-9)};
      const double unit = h * above.pull();
      expect_near("speed after 1000 steps on a slope, " + above.text() + " [m/s]", "Eq. (5.7), (5.9)",
                  speed_after(1000, above, t), 0, roundings(32, unit), {},
                  "With μ >= tan θ friction holds it: μ m g_n h is more than the pull, m g sin θ h.");
      // Each step's roundings of h g sin θ stay in the velocity.
      const int steps = 100;
      expect_near(
          "speed after 100 steps on a slope, " + below.text() + " [m/s]", "Eq. (5.7), (5.9)",
          speed_after(steps, below, t), steps * h * (below.pull() - below.mu * below.g_n()),
          roundings(32 * steps, unit),
          {{0, "It sticks on a slope too steep for its μ: the bound is too large. Are μ, g_n and h in it?"}},
          "With μ < tan θ it slides, by 1e-9 of g sin θ.");
      if (::testing::Test::HasFailure()) return;
    }
}

EXERCISE_TEST(FrictionBound, LetsABlockSlideFasterByTheSamePerStep) {
  Random random;
  for (int trial = 0; trial < 20 && !::testing::Test::HasFailure(); ++trial) {
    const double theta = random.uniform(0.2, 1.3), h = random.log_uniform(0.001, 0.03);
    const Slope slope{theta, h, random.uniform(0.05, 0.9) * std::tan(theta)};
    const Tangents t = random_tangents(random);
    const int steps = 200;
    const double sin = slope.pull(), cos = slope.g_n(), speed = steps * h * (sin - slope.mu * cos);
    expect_near(
        "speed after 200 steps down a slope, " + slope.text() + " [m/s]", "Eq. (5.7), (5.9)",
        speed_after(steps, slope, t), speed, roundings(8 * steps, steps * h * sin),
        {{0, "It sticks on a slope too steep for its μ: the bound is too large. Are μ, g_n and h in it?"},
         {steps * h * sin, "It slides as if there were no friction."},
         {steps * h * (sin - cos), "μ is missing."}},
        "a = g (sin θ - μ cos θ), the same each step.");
  }
}

// A block slides on a level floor along t1, by leapfrog with a half-step start, until it stops.
struct Slide {
  int steps = 0;
  double x = 0;
};

Slide slide_out(double v0, double mu, double g, double h) {
  const double m = 3, bound = friction_bound(mu, m, g, h);
  const Tangents t{Vec3::UnitX(), Vec3::UnitY()};
  const Mat3 K = Mat3::Identity() / m;
  Vec3 v = (v0 + mu * g * h / 2) * t.t1;
  Slide slide;
  for (; slide.steps < 100000; ++slide.steps) {
    v += friction_impulse(K, v, t, 0, bound) / m;
    if (!(v.norm() > 1e-12 * v0)) break;
    slide.x += h * v.dot(t.t1);
  }
  return slide;
}

EXERCISE_TEST(FrictionBound, StopsABlockAfterItsTimeAndDistance) {
  Random random;
  for (int trial = 0; trial < 20 && !::testing::Test::HasFailure(); ++trial) {
    const double mu = random.uniform(0.1, 1.5), g = random.uniform(1, 20), h = random.log_uniform(0.001, 0.01);
    // Not within 1e-3 of a half, where round-off may add a step.
    const double steps = random.integer(20, 200), z = steps + random.uniform(-0.499, 0.499),
                 v0 = z * mu * g * h;
    const Slide slide = slide_out(v0, mu, g, h);
    given() =
        "v0 = " + show(v0) + " m/s, μ = " + show(mu) + ", g = " + show(g) + " m/s², h = " + show(h) + " s";
    expect_near("steps that a block slides, v0/(μ g h) = " + show(z), "Eq. (5.7), (5.10)", slide.steps,
                std::round(z), {0, "a count"},
                {{0, "It stops within a step: the bound is too large. Is h in it?"}},
                "It stops after v0/(μ g), to the nearest step.");
    expect_near("distance until it stops [m]", "Eq. (5.7), (5.10)", slide.x, stopping_distance(v0, mu * g, h),
                {1e-12 * z * v0 * h, "a few roundings of v in each of up to 200 steps, added up"},
                {{0, "It stops within a step: the bound is too large. Is h in it?"}},
                "v0²/(2 μ g), less μ g h²/2 times the square of what v0/(μ g h) is off an integer.");
  }
}

EXERCISE_TEST(FrictionBound, StopsABlockAtADistanceThatIsOfSecondOrder) {
  const double mu = 0.4, g = 9.81, h = 0.02, v0 = (12 + 1.0 / 3) * mu * g * h;
  // v0/(μ g h) is a third off an integer at each halving: the error is μ g h²/18.
  expect_order(
      "error of the distance after which a sliding block stops [m]", "Eq. (5.7), (5.10)",
      [&](double step) { return std::abs(slide_out(v0, mu, g, step).x - v0 * v0 / (2 * mu * g)); }, h, 4, 2,
      0.05, "With a bound in N s the distance depends on h only by an error of order h².");
}

// A solid sphere that starts without spin. An impulse J changes the velocity u of its contact by 7/(2m) J, and v by
// J/m. It slides until u is zero.
EXERCISE_TEST(FrictionBound, LetsASphereSlideUntilItRolls) {
  const double mu = 0.2, g = 9.81, h = 0.01, m = 3, bound = friction_bound(mu, m, g, h);
  const int sliding = 40;
  const double v0 = 3.5 * mu * g * h * sliding;
  const Tangents t{Vec3::UnitX(), Vec3::UnitY()};
  const Mat3 K = 3.5 / m * Mat3::Identity();
  // Leapfrog's velocity is half a step early.
  double u = v0 + 3.5 * mu * g * h / 2, v = v0 + mu * g * h / 2;
  int steps = 0;
  for (; steps < 10000; ++steps) {
    const double J = friction_impulse(K, u * t.t1, t, 0, bound).x();
    u += 3.5 / m * J;
    v += J / m;
    if (!(u > 1e-9)) break;
  }
  expect_near("steps that a sphere slides, 2 v0/(7 μ g h) = 40", "Eq. (5.7), (5.11)", steps, sliding,
              {0, "a count"}, {{0, "It rolls at once: the bound is too large. Is h in it?"}},
              "It rolls after 2 v0/(7 μ g).");
  expect_near("its velocity then [m/s]", "Eq. (5.11)", v, 5 * v0 / 7, roundings(8 * sliding, v0), {},
              "5/7 of v0, for any bound.");
}

EXERCISE_TEST(FrictionBound, MayBeZero) {
  const std::string rule = "Zero is allowed: without μ, mass or gravity there is no friction.";
  expect_near("Λ for μ = 0 [N s]", "Eq. (5.7)", friction_bound(0, 3, 10, 0.02), 0, {0, "exact"}, {}, rule);
  expect_near("Λ for m = 0 [N s]", "Eq. (5.7)", friction_bound(0.4, 0, 10, 0.02), 0, {0, "exact"}, {}, rule);
  expect_near("Λ for g_n = 0 [N s]", "Eq. (5.7)", friction_bound(0.4, 3, 0, 0.02), 0, {0, "exact"}, {}, rule);
}

EXERCISE_TEST(FrictionBound, RejectsWhatIsNegativeOrNoNumber) {
  friction_bound(0.4, 3, 10, 0.02);
  const std::string rule =
      "See require_not_negative in require.hpp. A negative bound would turn the box inside out.";
  for (const double wrong : {-0.1, std::nan(""), HUGE_VAL}) {
    expect_rejects(
        "mu = " + show(wrong), "mu", [&] { friction_bound(wrong, 3, 10, 0.02); }, rule);
    expect_rejects(
        "mass = " + show(wrong), "mass", [&] { friction_bound(0.4, wrong, 10, 0.02); }, rule);
    expect_rejects(
        "normal_gravity = " + show(wrong), "normal_gravity", [&] { friction_bound(0.4, 3, wrong, 0.02); },
        rule);
  }
}

EXERCISE_TEST(FrictionBound, RejectsAStepThatIsNotPositive) {
  friction_bound(0.4, 3, 10, 0.02);
  for (const double h : {0.0, -0.01, std::nan(""), HUGE_VAL})
    expect_rejects(
        "h = " + show(h), "h", [&] { friction_bound(0.4, 3, 10, h); }, "See require_positive in require.hpp.");
}

EXERCISE_TEST(FrictionBound, ChecksAllArgumentsOfAZeroBound) {
  friction_bound(0.4, 3, 10, 0.02);
  const std::string clue =
      "Check all four arguments before you return. A bound of 0 is right only if the other arguments are "
      "valid.";
  const double nan = std::nan("");
  expect_rejects(
      "h = 0 where mu = 0", "h", [&] { friction_bound(0, 3, 10, 0); }, clue);
  expect_rejects(
      "h = NaN where mass = 0", "h", [&] { friction_bound(0.4, 0, 10, nan); }, clue);
  expect_rejects(
      "mass = NaN where mu = 0", "mass", [&] { friction_bound(0, nan, 10, 0.02); }, clue);
  expect_rejects(
      "mu = NaN where mass = 0", "mu", [&] { friction_bound(nan, 0, 10, 0.02); }, clue);
  expect_rejects(
      "mu = NaN where gravity = 0", "mu", [&] { friction_bound(nan, 3, 0, 0.02); }, clue);
  expect_rejects(
      "normal_gravity = -1 where mu = 0", "normal_gravity", [&] { friction_bound(0, 3, -1, 0.02); }, clue);
}

}  // namespace
