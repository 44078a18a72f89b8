// A ball that is dropped: the heights of its bounces, and the time of the last. Kick, drift and impacts
// alternate.
#include "balls.hpp"
#include "exercise_test.hpp"

using namespace spook;
using namespace spook::testing;

namespace {

EXERCISE(ResolveImpacts, "7.8 resolve_impacts");

// Steps until an impact is resolved; false if that takes too many steps.
bool fall(Ball& ball, double e, int most_steps) {
  for (int n = 0; n < most_steps; ++n) {
    if (ball.resolve(e)) return true;
    ball.step();
  }
  return false;
}

const std::string never = "The ball approaches the floor, u·n < 0, and fell through it.";

// Returns the height that the ball reaches with this speed after the impact.
double top_of(const Ball& ball, double v_after) {
  return ball.x + v_after * v_after / (2 * ball.g);
}

EXERCISE_TEST(ResolveImpacts, BallReturnsToItsHeight) {
  const double g = 9.81, h0 = 1;
  for (const double h : {0.01, 1.0 / 60, 0.03}) {
    Ball ball(g, h, h0);
    for (int bounce = 1; bounce <= 10 && !::testing::Test::HasFailure(); ++bounce) {
      if (!fall(ball, 1, 1000))
        return expect_true("bounce " + std::to_string(bounce), "Eq. (7.10)", false, never);
      const double v = std::sqrt(2 * g * (h0 - ball.x));
      expect_near(
          "height to which a ball returns, e = 1, bounce " + std::to_string(bounce) + ", " + ball.text() +
              " [m]",
          "Eq. (7.1), (7.11)", ball.apex(), h0, roundings(32 * ball.steps, v * v / g),
          {{top_of(ball, v - g * h),
            "It has lost about h g v a bounce: without W_f/2 the velocity is half a step old. Eq. (7.1)."},
           {top_of(ball, v + g * h),
            "It has gained about h g v a bounce: the velocity is half a step ahead. Add W_f/2, not W_f."},
           {ball.x, "It stays on the floor: this is for e = 0. The law has e = 1, and no friction."}},
          "With u at the time of the contact, the way up is the reverse of the way down, since leapfrog is "
          "reversible.");
      ball.step();
    }
  }
}

EXERCISE_TEST(ResolveImpacts, BallComesToTheSquareOfEAtEveryBounce) {
  const double g = 9.81, h0 = 2;
  for (const double e : {0.9, 0.5})
    for (const double h : {0.01, 0.001}) {
      Ball ball(g, h, h0);
      double top = h0, ideal = h0;
      // It is in the floor by at most one step of its way, d, and comes to e² h - (1 - e²) d. The losses of
      // many bounces, each times the e² of those after it, add up to less than d.
      const double deepest = h * (std::sqrt(2 * g * h0) + g * h);
      for (int bounce = 1; bounce <= 5 && !::testing::Test::HasFailure(); ++bounce) {
        if (!fall(ball, e, 10000))
          return expect_true("bounce " + std::to_string(bounce), "Eq. (7.10)", false, never);
        const double v = std::sqrt(2 * g * (top - ball.x));
        top = ball.x + e * e * (top - ball.x);
        ideal *= e * e;
        const std::string text =
            "bounce " + std::to_string(bounce) + ", e = " + show(e) + ", " + ball.text() + " [m]";
        expect_near("height to which a ball comes, given where it hit, " + text, "Eq. (7.1), (7.11)",
                    ball.apex(), top, roundings(32 * ball.steps, h0),
                    {{top_of(ball, e * v - (1 + e) * g * h / 2),
                      "The step took speed from it: without W_f/2 the velocity is half a step old. Eq. (7.1)."},
                     {top_of(ball, e * v + (1 + e) * g * h / 2),
                      "It gained speed from the step: the velocity is half a step ahead. Add W_f/2, not W_f."}},
                    "½ v² becomes e² times what it was.");
        expect_near("height to which a ball comes, " + text, "Eq. (7.11)", ball.apex(), ideal,
                    {deepest, "the largest depth at which the contact is found"});
        ball.step();
      }
    }
}

// With h = 1/128 s and g = 8 m/s² it meets the floor at 4 m/s after exactly 64 steps, and for e = 1/2 each flight
// takes half as many steps as the one before: 64, 32, ... 1. Nothing is lost to the step then.
EXERCISE_TEST(ResolveImpacts, BouncesEndAtTheirTime) {
  const double g = 8, h = 1.0 / 128, h0 = 1, e = 0.5, fall_time = std::sqrt(2 * h0 / g);
  Ball ball(g, h, h0, 1e-9);
  double time = fall_time, flight = 2 * fall_time, top = h0;
  for (int bounce = 1; bounce <= 8; ++bounce) {
    if (!fall(ball, e, 1000))
      return expect_true("bounce " + std::to_string(bounce), "Eq. (7.10)", false, never);
    top *= e * e;
    flight *= e;
    const std::string text =
        " of bounce " + std::to_string(bounce) + ", e = 0.5, which is at a whole number of steps";
    expect_near("time" + text + " [s]", "Eq. (7.12)", ball.time(), time, roundings(8, 2), {},
                "√(2 h0/g) (1 + 2e + 2e² + ... ).");
    expect_near("height" + text + " [m]", "Eq. (7.11)", ball.apex(), top, roundings(32 * ball.steps, h0), {},
                "h0 e^(2n), exactly as no bounce is between two steps.");
    if (::testing::Test::HasFailure()) return;
    ball.step();
    time += flight;
  }
  // The last flight was one step, and those yet to come take ½ + ¼ + ... of one.
  expect_near("time at which all bounces end, and one step after bounce 8 [s]", "Eq. (7.12)", ball.time(),
              fall_time * (1 + e) / (1 - e), roundings(8, 2), {}, "√(2 h0/g) (1+e)/(1-e): 1.5 s.");
}

// The end of all bounces, as told by a speed v right after one: (2v/g)(1 + e + e² + ...) later.
double end_of_bounces(double h, double e, int bounces) {
  const double g = 9.81;
  Ball ball(g, h, 1);
  for (int bounce = 1; bounce <= bounces; ++bounce) {
    if (!fall(ball, e, 100000)) return std::nan("");
    if (bounce < bounces) ball.step();
  }
  return ball.time() + 2 * ball.v() / (g * (1 - e));
}

EXERCISE_TEST(ResolveImpacts, BouncesEndWithinSomeStepsOfTheirTime) {
  const double e = 0.8, exact = std::sqrt(2 / 9.81) * (1 + e) / (1 - e);
  const int bounces = 5;
  // Bounce n is seen up to h late, and the way back up to the floor takes up to 2h/e. A top that is low by up to
  // h v makes the flight shorter by up to 4h/eⁿ, and after bounce N all flights yet to come by 4h e^(2-N)/(1-e).
  double steps = 4 * std::pow(e, 2 - bounces) / (1 - e) + 1;
  for (int n = 1; n < bounces; ++n) steps += std::max(1 + 2 / e, 4 / std::pow(e, n));
  for (const double h : {1e-2, 1e-3, 1e-4})
    expect_near("end of all bounces, e = 0.8, told after bounce 5, h = " + show(h) + " s [s]", "Eq. (7.12)",
                end_of_bounces(h, e, bounces), exact,
                {1.1 * steps * h, show(std::round(1.1 * steps)) + " steps"}, {},
                "√(2 h0/g) (1+e)/(1-e): 4.06 s.");
}

}  // namespace
