// The notes' update: a step along the tangent, then normalisation. It turns by 2 atan(h|ω|/2).
#include "exercise_test.hpp"
#include "regions.hpp"
#include "relative_scales.hpp"
#include "rotations.hpp"

using namespace spook;
using namespace spook::testing;

namespace {

EXERCISE(UpdateFirstOrder, "2.2 update_first_order");

struct Step {
  Random random;
  Quat q = random.rotation();
  Vec3 axis = random.unit_vector();
  double speed = random.uniform(1, 3);
  double h = random.uniform(0.2, 0.3);
  Vec3 omega = speed * axis;
};

EXERCISE_TEST(UpdateFirstOrder, TurnsByTwiceTheArcTangent) {
  const Step s;
  const Quat got = update_first_order(s.q, s.omega, s.h);
  const auto turned_by = [&](double angle) { return turn_about(s.axis, angle) * s.q; };
  const double x = s.h * s.speed;
  const Quat expected = turned_by(2 * std::atan(x / 2));
  expect_same_rotation(
      "q after one update (w, x, y, z)", "Eq. (2.4), (2.5)", got, expected, roundings(16),
      {{scaled(std::sqrt(1 + x * x / 4), expected),
        "The direction is right, the length is not: normalise the sum."},
       {scaled(1 / std::sqrt(1 + x * x / 4), expected),
        "The direction is right, the length is not: divide by the norm, not by its square."},
       {turned_by(2 * std::atan(x)), "The step is twice too long: does it contain the ½ of Eq. (2.3)?"},
       {turned_by(2 * std::atan(x / 4)), "The step is half too short: the ½ is already in quaternion_rate."},
       {turned_by(-2 * std::atan(x / 2)), "This body turns backwards."},
       {s.q * turn_about(s.axis, 2 * std::atan(x / 2)),
        "This is q + (h/2) q ω: right if ω were in body coordinates. Ours is in world coordinates: ω on the "
        "left."},
       {turned_by(2 * std::atan(s.speed / 2)), "h is missing: this moves by the rate of a whole second."},
       {turned_by(2 * std::atan(s.h * x / 2)), "One h too many."},
       {turn_about(s.axis, 2 * std::acos(0.0)) * s.q,
        "This is the rate alone, normalised. Add h times it to q."},
       {s.q, "q has not moved."},
       {turned_by(x),
        "This turns by h|ω|, exactly: that is exercise 2.3. This exercise is the notes' update, for "
        "comparison."}},
      std::abs(coefficients(got).norm() - 1) > 1e-12
          ? "Its length is not 1. Divide q + h q' by its exact length, with a square root and not a series."
          : "Eq. (2.4): q plus h times quaternion_rate, then normalised.");
}

// The number of steps is odd, since a division by |q|² in place of |q| corrects itself at each even step.
EXERCISE_TEST(UpdateFirstOrder, KeepsUnitLengthFor1001Steps) {
  const Vec3 omega(0, 0, 1);
  const double h = 0.1;
  const int steps = 1001;
  Quat q(1, 0, 0, 0);
  for (int n = 0; n < steps; ++n) q = update_first_order(q, omega, h);
  expect_near(
      "|q| after 1001 steps, h ω = 0.1", "Eq. (2.4)", q.norm(), 1, roundings(8),
      {{std::pow(1 + h * h / 4, steps / 2.0),
        "Each step has lengthened q by √(1 + (hω/2)²), since it follows the tangent of the unit sphere. "
        "Normalise."}},
      "Normalise after the sum: the step leaves the unit sphere.");
}

EXERCISE_TEST(UpdateFirstOrder, ComesBackToUnitLengthFromAnyDistance) {
  const Step s;
  for (const double x : {1.0, 1e-2, 1e-4, 1e-5, 1e-6, 2e-7}) {  // the sum is too long by x²/8
    const Quat next = update_first_order(s.q, s.omega, x / s.speed);
    expect_near(
        "|q| - 1 after an update with hω = " + show(x), "Eq. (2.4)", next.norm() - 1, 0, roundings(8),
        {{x * x / 8, "This is the sum itself. Its error is small but adds up: normalise in every step."}},
        "Normalise after the sum, however small the error is.");
  }
}

// 2 atan(x/2)/x - 1 = -x²/12 + x⁴/80 - …, an alternating series: the remainder is smaller than its first term.
EXERCISE_TEST(UpdateFirstOrder, HasARelativeErrorOfATwelfthOfTheAngleSquared) {
  const Step s;
  for (const double x : {0.2, 0.1, 0.05}) {
    const Quat next = update_first_order(s.q, s.omega, x / s.speed);
    const double relative_error = angle_about(s.axis, s.q, next) / x - 1;
    expect_near(
        "relative error of the angle at hω = " + show(x), "Eq. (2.5)", relative_error, -x * x / 12,
        {std::pow(x, 4) / 80 + 1e-14, "the next term of the series, (hω)⁴/80"},
        {{0, "The turn is exact: that is exercise 2.3. This exercise is the notes' update, for comparison."},
         {2 * std::atan(x) / x - 1, "It turns twice as far: does it contain the ½ of Eq. (2.3)?"}},
        "The tangent of length hω/2 to the unit circle spans an angle of atan(hω/2).");
  }
}

EXERCISE_TEST(UpdateFirstOrder, TurnsTooSlowlyByOrderTwo) {
  const Step s;
  const double time = 1;
  const auto error = [&](double h) {
    Quat q = s.q;
    const int steps = static_cast<int>(std::lround(time / h));
    for (int n = 0; n < steps; ++n) q = update_first_order(q, s.omega, h);
    return std::abs(angle_about(s.axis, turn_about(s.axis, s.speed * time) * s.q, q));
  };
  expect_order(
      "constant ω, error of the angle after 1 s [rad]", "Eq. (2.5)", error, 0.1, 3, 2, 0.1,
      "With ω constant, the angle is off by (hω)²/12 of itself: order 2. Order 0 means another speed.");
}

EXERCISE_TEST(UpdateFirstOrder, LeavesABodyAtRestAlone) {
  const Step s;
  expect_same_rotation("q of a body with ω = 0 (w, x, y, z)", "Eq. (2.4)",
                       update_first_order(s.q, Vec3::Zero(), s.h), s.q, roundings(4), {},
                       "With ω = 0, Eq. (2.4) is q itself.");
  expect_same_rotation("q after a step of h = 0 (w, x, y, z)", "Eq. (2.4)", update_first_order(s.q, s.omega, 0),
                       s.q, roundings(4), {}, "A step of 0 turns nothing. Do not replace it by another step.");
}

EXERCISE_TEST(UpdateFirstOrder, BackwardsUndoesForwards) {
  const Step s;
  const Quat there = update_first_order(s.q, s.omega, s.h);
  expect_same_rotation("q after an update of h and one of -h (w, x, y, z)", "Eq. (2.4)",
                       update_first_order(there, s.omega, -s.h), s.q, roundings(32), {},
                       "The atan in Eq. (2.5) is odd: a step of -h turns back by the same angle.");
}

EXERCISE_TEST(UpdateFirstOrder, TurnsFromAnyOrientation) {
  Random random;
  Regions regions({"w < 0", "w > 0", "backwards", "comes to w < 0"});
  while (regions.lack_draws()) {
    const Quat q = random.rotation();
    const Vec3 axis = random.unit_vector();
    const double speed = random.uniform(0, 5), h = random.uniform(-0.4, 0.4);
    const Quat turned = turn_about(axis, 2 * std::atan(h * speed / 2)) * q;
    regions.draw(
        {{"w < 0", q.w() < 0}, {"w > 0", q.w() > 0}, {"backwards", h < 0}, {"comes to w < 0", turned.w() < 0}});
    expect_same_rotation("q after h = " + show(h) + " s at " + show(speed) + " rad/s (w, x, y, z)",
                         "Eq. (2.4), (2.5)", update_first_order(q, speed * axis, h), turned, roundings(32),
                         {{turn_about(axis, -2 * std::atan(h * speed / 2)) * q, "It turned the other way."},
                          {turn_about(axis, h * speed) * q, "This is the exact turn, Eq. (2.6)."}},
                         "A turn by 2 atan(h|ω|/2) about ω, from any q: w may have either sign.");
  }
}

EXERCISE_TEST(UpdateFirstOrder, DropsNothingSmall) {
  const Vec3 axis(0.6, 0, 0.8);
  for (const double part : relative_scales) {
    const Quat got = update_first_order(Quat(1, 0, 0, 0), part * axis, 1);
    expect_near_vector<Vec3>("axis part of q = 1 after a turn by " + show(part) + " rad, over half of that",
                             "Eq. (2.4)", Vec3(got.vec() / (part / 2)), axis / std::hypot(1, part / 2),
                             roundings(8), {{Vec3::Zero(), "It has not turned. " + small_is_dropped}},
                             small_is_dropped);
    if (::testing::Test::HasFailure()) return;
  }
}

}  // namespace
