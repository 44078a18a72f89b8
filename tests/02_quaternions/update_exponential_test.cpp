// The exact turn about a constant ω: any angle, however large or small.
#include "exercise_test.hpp"
#include "regions.hpp"
#include "relative_scales.hpp"
#include "rotations.hpp"

using namespace spook;
using namespace spook::testing;

namespace {

EXERCISE(UpdateExponential, "2.3 update_exponential");

const double pi = std::acos(-1.0);

EXERCISE_TEST(UpdateExponential, QuarterTurnAboutZTakesXToY) {
  const Quat got = update_exponential(Quat(1, 0, 0, 0), Vec3(0, 0, pi / 2), 1);
  expect_near_vector<Vec3>(
      "where (1, 0, 0) is after 1 s at ω = (0, 0, π/2)", "Eq. (2.1), (2.6)", got * Vec3(1, 0, 0), {0, 1, 0},
      roundings(8),
      {{{-1, 0, 0}, "This is half a turn: Eq. (2.6) has the half angle, θ/2, in both places."},
       {{std::sqrt(0.5), std::sqrt(0.5), 0}, "This is an eighth of a turn: halve the angle once only."},
       {{0, -1, 0}, "This turns backwards."}},
      (got * Vec3(1, 0, 0) - Vec3(0, 1, 0)).norm() < 0.1
          ? "It is nearly a quarter turn: are sine and cosine series that have been cut off? std::sin and "
            "std::cos are right for every angle."
          : "A quarter turn about z takes x to y.");
}

EXERCISE_TEST(UpdateExponential, TurnsByTheWholeAngleAboutOmega) {
  Random random;
  const Quat q = random.rotation();
  const Vec3 axis = random.unit_vector();
  const double speed = random.uniform(1.5, 3), h = random.uniform(0.2, 0.3);
  const Quat got = update_exponential(q, speed * axis, h);

  const auto turned_by = [&](double angle) { return turn_about(axis, angle) * q; };
  const double x = h * speed;
  const Vec3 v = std::sin(x / 2) * axis;
  const Quat long_axis(std::cos(x / 2), speed * v.x(), speed * v.y(), speed * v.z());
  expect_same_rotation(
      "q after one update (w, x, y, z)", "Eq. (2.6)", got, turned_by(x), roundings(16),
      {{turned_by(2 * x), "Twice the angle: Eq. (2.6) has the half angle, θ/2, in both places."},
       {turned_by(x / 2), "Half the angle: halve it once only."},
       {turned_by(-x), "This body turns backwards."},
       {q * turn_about(axis, x),
        "The turn was multiplied from the right: right if ω were in body coordinates. Ours is in world "
        "coordinates."},
       {Quat(v.x(), v.y(), v.z(), std::cos(x / 2)) * q,
        "The four numbers are in the wrong places: Quat(w, x, y, z) takes w first; only coeffs() has it last."},
       {long_axis * q, "The axis has the length |ω|: divide ω by |ω|, so that the turn is a unit quaternion."},
       {(long_axis * q).normalized(),
        "The axis has the length |ω|. Normalising afterwards hides this, but the angle is wrong."},
       {turned_by(2 * std::atan(x / 2)),
        "This is the first-order update, 2 atan(hω/2): Eq. (2.5). Here θ is exact."},
       {turned_by(speed), "h is missing: this turns for a whole second."},
       {turned_by(h), "|ω| is missing from the angle: θ = h |ω|."},
       {turn_about(axis, x), "This is the turn alone: multiply it with q."},
       {q, "q has not moved."}},
      "Eq. (2.6): the turn by θ = h|ω| about ω/|ω|, times q.");
}

EXERCISE_TEST(UpdateExponential, MakesSeveralTurnsInOneStep) {
  Random random;
  for (const double turns : {0.5, 0.9, 1.0, 1.25, 2.5, 7.75}) {
    const Quat q = random.rotation();
    const Vec3 axis = random.unit_vector();
    const double angle = 2 * pi * turns, h = random.uniform(0.1, 1);
    expect_same_rotation("q after " + show(turns) + " turns in one step (w, x, y, z)", "Eq. (2.6)",
                         update_exponential(q, angle / h * axis, h), turn_about(axis, angle) * q,
                         roundings(16 + 4 * angle),
                         {{turn_about(axis, 2 * std::atan(angle / 2)) * q,
                           "This is the first-order update: it never turns by more than half a turn a step."}},
                         "Eq. (2.6) holds for any angle. Use sine and cosine, not a truncated series.");
  }
}

EXERCISE_TEST(UpdateExponential, LeavesABodyAtRestAlone) {
  Random random;
  const Quat q = random.rotation();
  for (const double speed : {0.0, 1e-300, 1e-200, 1e-160})
    expect_same_rotation("q after 1 s at |ω| = " + show(speed) + " rad/s (w, x, y, z)", "Eq. (2.6)",
                         update_exponential(q, Vec3(0, 0, speed), 1), q, roundings(8), {},
                         "ω/|ω| is 0/0 at rest, and |ω|² is 0 long before ω is. Only sin(θ/2)/|ω| is needed, "
                         "and it tends to h/2.");
  expect_same_rotation("q after a step of h = 0 at 3 rad/s (w, x, y, z)", "Eq. (2.6)",
                       update_exponential(q, Vec3(0, 0, 3), 0), q, roundings(8), {},
                       "A step of 0 turns nothing. Do not replace it by another step.");
}

EXERCISE_TEST(UpdateExponential, DropsNoSmallTurn) {
  for (const double speed : {1e-12, 1e-10, 1e-8, 1e-6, 1e-4}) {
    const Vec3 axis(0.6, 0, 0.8);
    const Quat got = update_exponential(Quat(1, 0, 0, 0), speed * axis, 1);
    expect_near_vector<Vec3>(
        "axis part of q = 1 after 1 s at |ω| = " + show(speed) + " rad/s, over |ω|/2", "Eq. (2.6)",
        got.vec() / (speed / 2), std::sin(speed / 2) / (speed / 2) * axis, roundings(16),
        {{Vec3::Zero(), "This small turn was dropped. A million of them add up to a large one."}},
        "For a small angle, the axis part tends to (h/2) ω. From h|ω| = 1e-7 on the next term of the sine, "
        "with "
        "the factor (h|ω|)²/24, is larger than a rounding and is needed.");
  }
}

EXERCISE_TEST(UpdateExponential, DropsNoSmallPartOfOmega) {
  for (const double part : relative_scales)
    for (const Vec3& omega : lopsided(part)) {
      const Quat got = update_exponential(Quat(1, 0, 0, 0), omega, 1);
      expect_each_near<Vec3>("axis part of q = 1 after 1 s", "Eq. (2.6)", got.vec(),
                             std::sin(omega.norm() / 2) / omega.norm() * omega, 16);
      if (::testing::Test::HasFailure()) return;
    }
}

EXERCISE_TEST(UpdateExponential, ClosesTheCircleInAnyNumberOfSteps) {
  Random random;
  const Vec3 axis = random.unit_vector();
  for (const int steps : {1, 2, 3, 7, 60, 1000}) {
    const Quat start = random.rotation();
    const double h = 0.01, angle = 2 * pi / steps;
    Quat q = start;
    for (int n = 0; n < steps; ++n) q = update_exponential(q, angle / h * axis, h);
    expect_same_rotation(
        "q after one turn in " + std::to_string(steps) + " steps (w, x, y, z)", "Eq. (2.6)", q, start,
        roundings(16 * steps + 16),
        {{turn_about(axis, steps * 2 * std::atan(angle / 2)) * start,
          "The circle does not close: this is the first-order update, which is too slow by Eq. "
          "(2.5)."}},
        "With a constant ω a step has no error: N steps of 2π/N make one turn.");
  }
}

EXERCISE_TEST(UpdateExponential, KeepsUnitLength) {
  Random random;
  Quat q = random.rotation();
  const int steps = 10000;
  for (int n = 0; n < steps; ++n) q = update_exponential(q, random.vector(5), 0.1);
  expect_near("|q| after 1e4 random turns", "Eq. (2.6)", q.norm(), 1, roundings(4 * steps), {},
              "The turn must be a unit quaternion: cos² + sin² = 1 needs an axis of length 1.");
}

// Equal turns have equal errors of a rounding or two, so the errors add up with one sign.
EXERCISE_TEST(UpdateExponential, KeepsLengthErrorsFromAddingUp) {
  Random random;
  double farthest = 0;
  for (int trial = 0; trial < 10; ++trial) {
    const Vec3 omega = random.vector(5);
    Quat q = random.rotation();
    for (int n = 0; n < 10000; ++n) q = update_exponential(q, omega, 0.1);
    farthest = std::max(farthest, std::abs(q.norm() - 1));
  }
  expect_at_most("| |q| - 1 | after 1e4 equal turns, the largest of ten", "Eq. (2.6)", farthest, 16 * 2.3e-16,
                 "16 roundings, all of the last step: each coefficient has a few",
                 "The product of two unit quaternions has length 1 up to a rounding, but these add up step by "
                 "step. Normalise it, since (2.7) assumes |q| = 1.");
}

EXERCISE_TEST(UpdateExponential, BackwardsUndoesForwards) {
  Random random;
  const Quat q = random.rotation();
  const Vec3 omega = random.vector_of_length(1, 3);
  const Quat there = update_exponential(q, omega, 0.7);
  expect_same_rotation(
      "q after an update of h and one of -h (w, x, y, z)", "Eq. (2.6)", update_exponential(there, omega, -0.7),
      q, roundings(32), {},
      "The angle h|ω| is negative when h is. Do not treat it as small: compare its absolute value.");
}

EXERCISE_TEST(UpdateExponential, TurnsFromAnyOrientation) {
  Random random;
  Regions regions({"w < 0", "w > 0", "backwards", "more than half a turn", "comes to w < 0"});
  while (regions.lack_draws()) {
    const Quat q = random.rotation();
    const Vec3 axis = random.unit_vector();
    const double speed = random.uniform(0, 20), h = random.uniform(-0.4, 0.4);
    const Quat turned = turn_about(axis, h * speed) * q;
    regions.draw({{"w < 0", q.w() < 0},
                  {"w > 0", q.w() > 0},
                  {"backwards", h < 0},
                  {"more than half a turn", std::abs(h * speed) > std::acos(-1)},
                  {"comes to w < 0", turned.w() < 0}});
    expect_same_rotation(
        "q after h = " + show(h) + " s at " + show(speed) + " rad/s (w, x, y, z)", "Eq. (2.6)",
        update_exponential(q, speed * axis, h), turned, roundings(32),
        {{turn_about(axis, -h * speed) * q, "It turned the other way."},
         {q * turn_about(axis, h * speed),
          "This is the turn on the right of q. Multiply it from the left: ω is in world coordinates."}},
        "The turn by h|ω| about ω, from any q: w may have either sign.");
  }
}

}  // namespace
