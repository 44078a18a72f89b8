// Kick, drift and the half-step start, one body at a time.
#include "01_leapfrog/leapfrog.hpp"
#include "exercise_test.hpp"
#include "relative_scales.hpp"

using namespace spook;
using namespace spook::testing;

namespace {

EXERCISE(Kick, "1.1 kick");
EXERCISE(Drift, "1.2 drift");
EXERCISE(HalfStepStart, "1.3 half_step_start");

struct OneBody {
  Random random;
  Vec3 x = random.vector(3);
  Vec3 v = random.vector(3);
  Vec3 f = random.vector(10);
  double mass = random.uniform(2, 5);
  double h = random.uniform(0.01, 0.02);
  OneBody() {
    given() = "given x = " + show(x) + " m, v = " + show(v) + " m/s, f = " + show(f) +
              " N, 1/m = " + show(1 / mass) + " /kg, h = " + show(h) + " s";
  }
};

const std::string no_time = "A step of 0 changes nothing. Do not replace it by another step.";

/// Tests small changes of (1, 1, 1), to a rounding or two.
void expect_small_change(const std::string& what, const std::string& equation,
                         const std::function<Vec3(const Vec3&, const Vec3&)>& step) {
  const Vec3 large(1, 1, 1);
  for (const double part : relative_scales) {
    const Vec3 change = part * Vec3(0.5, -1, 0.25);
    expect_near_vector(what + " that changes by " + show(part) + " of itself", equation, step(large, change),
                       large + change, roundings(3), {{large, "It has not changed. " + small_is_dropped}},
                       small_is_dropped);
    const Vec3 uneven(1, part, -1);
    expect_near(what + " whose second number is " + show(part) + " of the others, that number", equation,
                step(uneven, Vec3::Zero()).y(), part, roundings(2, part),
                {{0, "It is gone. " + small_is_dropped}}, small_is_dropped);
    if (::testing::Test::HasFailure()) return;
  }
}

EXERCISE_TEST(Kick, AddsForceOverMassTimesStep) {
  const OneBody b;
  const Vec3 got = kick(b.v, b.f, 1 / b.mass, b.h);
  expect_near_vector(
      "v after one kick [m/s]", "Eq. (1.3)", got, b.v + b.h * b.f / b.mass, roundings(8, 5),
      {{b.v + b.h * b.f, "This is v + h f: the force has not been divided by the mass."},
       {b.v + b.h * b.f * b.mass, "This is v + h m f: the function is given 1/m, so multiply by it."},
       {b.v + b.h * b.h * b.f / b.mass, "This is v + h² f/m: one h too many. Check the units: N s / kg = m/s."},
       {b.v + b.f / b.mass, "This is v + f/m: h is missing, and m/s² has been added to m/s."},
       {b.v + b.f / b.mass / b.h,
        "This is v + f/(h m), as the notes print it in (15). Check its units: h⁻¹ is a slip."},
       {b.v + b.h / 2 * b.f / b.mass, "This is half a kick. Only the start of a simulation takes half a step."},
       {b.v, "v has not changed. In C++, 1 / 2 is 0: write 0.5, or h / 2."},
       {b.v - b.h * b.f / b.mass, "The sign: a force accelerates a body along itself."}},
      "Eq. (1.3) adds h f/m to v.");
}

EXERCISE_TEST(Kick, LeavesAFixedBodyAlone) {
  const OneBody b;
  const Vec3 got = kick(b.v, 1e9 * b.f, 0, b.h);
  expect_near_vector("v of a body with inverse mass 0 [m/s]", "Eq. (1.3)", got, b.v, {0, "exact"},
                     {{Vec3::Zero(), "It has been stopped. A body with 1/m = 0 keeps its velocity."}},
                     "An inverse mass of 0 is a body that no force moves. Multiply by it; never divide by it.");
}

EXERCISE_TEST(Kick, BackwardsUndoesForwards) {
  const OneBody b;
  const Vec3 there = kick(b.v, b.f, 1 / b.mass, b.h);
  expect_near_vector("v after a kick of h and one of -h [m/s]", "Eq. (1.3)", kick(there, b.f, 1 / b.mass, -b.h),
                     b.v, roundings(8, 5), {}, "The change must be proportional to h, for either sign of it.");
  expect_near_vector("v after a kick of h = 0 [m/s]", "Eq. (1.3)", kick(b.v, b.f, 1 / b.mass, 0), b.v,
                     {0, "exact"}, {}, no_time);
}

EXERCISE_TEST(Kick, DropsNoSmallChange) {
  expect_small_change("a velocity [m/s]", "Eq. (1.3)",
                      [](const Vec3& v, const Vec3& change) { return kick(v, change / 0.5, 4, 0.125); });
  const Vec3 got = kick(Vec3(1e20, 0, 3), Vec3(0, 8, 16), 0.5, 0.25);
  expect_near_vector<Vec3>(
      "v of a body at (1e20, 0, 3) m/s, pushed by (0, 8, 16) N, 2 kg, h = 0.25 s [m/s]", "Eq. (1.3)", got,
      Vec3(1e20, 1, 5), {0, "exact"},
      {{Vec3(1e20, 0, 3), "The change is small beside |v|, but v_y and v_z hold it with all digits."}});
}

EXERCISE_TEST(Drift, MovesByVelocityTimesStep) {
  const OneBody b;
  const Vec3 got = drift(b.x, b.v, b.h);
  expect_near_vector("x after one drift [m]", "Eq. (1.4)", got, b.x + b.h * b.v, roundings(8, 5),
                     {{b.x + b.v, "This is x + v: h is missing, and m/s has been added to m."},
                      {b.x + b.h / 2 * b.v, "This is half a drift. Leapfrog drifts by whole steps."},
                      {b.x + b.h * b.h * b.v, "This is x + h² v: one h too many."},
                      {b.x - b.h * b.v, "The sign: a body moves along its velocity."},
                      {b.x, "The position has not changed: return x + h v."},
                      {b.h * b.v, "This is h v, the change alone. Add it to x."}},
                     "Eq. (1.4) adds h v to x.");
}

EXERCISE_TEST(Drift, BackwardsUndoesForwards) {
  const OneBody b;
  expect_near_vector("x after a drift of h and one of -h [m]", "Eq. (1.4)",
                     drift(drift(b.x, b.v, b.h), b.v, -b.h), b.x, roundings(8, 5), {},
                     "The change must be proportional to h, for either sign of it.");
  expect_near_vector("x after a drift of h = 0 [m]", "Eq. (1.4)", drift(b.x, b.v, 0), b.x, {0, "exact"}, {},
                     no_time);
}

EXERCISE_TEST(Drift, DropsNoSmallChange) {
  expect_small_change("a position [m]", "Eq. (1.4)",
                      [](const Vec3& x, const Vec3& change) { return drift(x, 8 * change, 0.125); });
}

EXERCISE_TEST(HalfStepStart, GoesBackHalfAStep) {
  const OneBody b;
  const Vec3 change = b.h * b.f / b.mass;
  expect_near_vector("v half a step before the start [m/s]", "Eq. (1.5)",
                     half_step_start(b.v, b.f, 1 / b.mass, b.h), b.v - change / 2, roundings(8, 5),
                     {{b.v + change / 2,
                       "This is half a step forwards. The first kick is yet to come: go back, so that "
                       "it lands at +h/2."},
                      {b.v - change, "This is a whole step back; the first kick would only bring v to time 0."},
                      {b.v,
                       "This is v unshifted: all velocities would be half a step ahead, of first order only. "
                       "(In C++, 1 / 2 is 0: "
                       "write h / 2.)"},
                      {b.v + change, "This is a whole step forwards: go back, and half a step only."},
                      {b.v - b.h * b.f / 2, "The force has not been divided by the mass."}},
                     "Eq. (1.5) subtracts (h/2) f/m from v.");
}

EXERCISE_TEST(HalfStepStart, DropsNoSmallChange) {
  expect_small_change("a velocity [m/s]", "Eq. (1.5)", [](const Vec3& v, const Vec3& change) {
    return half_step_start(v, -8 * change, 2, 0.125);
  });
}

EXERCISE_TEST(HalfStepStart, TakesStepsOfEitherSign) {
  const OneBody b;
  const Vec3 back = half_step_start(b.v, b.f, 1 / b.mass, b.h);
  expect_near_vector(
      "v half a step of -h before the start [m/s]", "Eq. (1.5)", half_step_start(b.v, b.f, 1 / b.mass, -b.h),
      b.v + b.h / 2 * b.f / b.mass, roundings(8, 5),
      {{back, "The sign of h has been lost. When time runs backwards, half a step back is half a step ahead."},
       {b.v, "Nothing has changed. A negative h is allowed."}},
      "Eq. (1.5) with -h for h.");
  expect_near_vector("v half a step of h = 0 before the start [m/s]", "Eq. (1.5)",
                     half_step_start(b.v, b.f, 1 / b.mass, 0), b.v, {0, "exact"}, {}, no_time);
}

EXERCISE_TEST(HalfStepStart, LeavesAFixedBodyAlone) {
  const OneBody b;
  expect_near_vector("v of a body with inverse mass 0, half a step before the start [m/s]", "Eq. (1.5)",
                     half_step_start(b.v, 1e9 * b.f, 0, b.h), b.v, {0, "exact"}, {},
                     "An inverse mass of 0 is a body that no force moves. Put no other in its place.");
}

EXERCISE_TEST(HalfStepStart, MakesFreeFallExact) {
  const double g = 9.81, mass = 2, h = 1.0 / 60;
  const int steps = 120;
  const Vec3 weight(0, 0, -mass * g);
  const Vec3 v0(1, 0, 3);
  Vec3 x(0, 0, 0);
  Vec3 v = half_step_start(v0, weight, 1 / mass, h);
  for (int n = 0; n < steps; ++n) {
    v = kick(v, weight, 1 / mass, h);
    x = drift(x, v, h);
  }
  const double t = steps * h;
  const Vec3 closed_form = v0 * t + Vec3(0, 0, -g * t * t / 2);
  expect_near_vector("x of a thrown ball after 2 s [m]", "Eq. (1.5)", x, closed_form, roundings(4 * steps, 20),
                     {{closed_form - Vec3(0, 0, g * h * t / 2),
                       "It is g h t/2 too low: the velocity was not shifted back by half a step."},
                      {closed_form - Vec3(0, 0, g * h * t),
                       "It is g h t too low: the velocity was shifted by half a step the wrong way."}},
                     "Under constant force, a leapfrog started half a step back follows the parabola exactly.");
}

}  // namespace
