// The asymmetric top I = (1, 2, 3), ω = (0.01, 1, 0.01): its period, and 1e5 steps of it.
#include "top.hpp"

using namespace spook;
using namespace spook::testing;

namespace {

EXERCISE(FreeRotation, "2.6 free_rotation");

/// Seconds between the first two times that ω_2 falls through 0, in body coordinates; ∞ if it never does. There ω_2''
/// is 0, so a straight line between two steps finds the time to h³.
double measured_period(double h) {
  Top top = tumbling_top();
  double before = top.omega_body()[1], first = std::nan("");
  for (double t = 0; t < 100; t += h) {
    top.step(h);
    const double now = top.omega_body()[1];
    if (before > 0 && now <= 0) {
      const double crossing = t + h * before / (before - now);
      if (!std::isnan(first)) return crossing - first;
      first = crossing;
    }
    before = now;
  }
  return std::isnan(before) ? before : HUGE_VAL;
}

EXERCISE_TEST(FreeRotation, HasTheTopsPeriod) {
  const double h = 0.005, period = tumbling_period();
  const std::string otherwise =
      "A change of 2e-4 in the energy would end the tumbling, so the period shows the smallest mistake. "
      "Infinity means that it never tumbled.";
  expect_near("period of the top at h = 0.005 s [s]", "Eq. (2.12)", measured_period(h), period,
              {period * h * h, "(h ω)² of the period"}, {}, otherwise);
  expect_second_order(
      "error of the period [s]", "Eq. (2.11), (2.12)",
      [&](double step) { return std::abs(measured_period(step) - period); }, 0.04, 1e-7, otherwise);
}

EXERCISE_TEST(FreeRotation, StandsOnItsHeadAfterHalfAPeriodAndReturns) {
  const double half = tumbling_period() / 2;
  const auto error = [&](double h) {
    const Top head = after(tumbling_top(), half, h), foot = after(head, half, h);
    return std::hypot((head.omega_body() - Vec3(-0.01, -1, 0.01)).norm(),
                      (foot.omega_body() - Vec3(0.01, 1, 0.01)).norm());
  };
  expect_second_order(
      "ω in body coordinates: difference from (-0.01, -1, 0.01) after half a period, and from the start after "
      "one [rad/s]",
      "Eq. (2.12)", error, 0.1, 1e-10,
      "After half a period, axis 2 points the other way. With a constant ω it never does.");
}

EXERCISE_TEST(FreeRotation, KeepsLFor1e5Steps) {
  Top top = tumbling_top();
  const Vec3 before = top.L();
  const int steps = 100000;
  top.step(0.1);
  expect_moved(top, tumbling_top());
  for (int n = 1; n < steps; ++n) top.step(0.1);
  expect_near_vector<Vec3>(
      "L after 1e5 steps of 0.1 s [kg m²/s]", "Eq. (2.11)", top.L(), before, roundings(16.0 * steps, 2), {},
      "A step ends with ω = I⁻¹ L, and the next one begins with L = I ω. Do both use the same q? If q is not "
      "normalised, its length makes both wrong.");
  expect_near(
      "|q| after 1e5 steps", "Eq. (2.11)", top.q.norm(), 1, roundings(16.0 * steps), {},
      "Turns are unit quaternions, so |q| = 1 up to round-off. Normalise to remove the round-off, too.");
}

EXERCISE_TEST(FreeRotation, KeepsEnergyInItsBandFor1e5Steps) {
  const double h = 0.1, period = tumbling_period();
  const int steps = 100000;
  Top top = tumbling_top();
  const double energy = top.energy();
  double early = 0, all = 0, before = 1;
  int tumbles = 0;
  for (int n = 0; n < steps; ++n) {
    top.step(h);
    const double error = std::abs(top.energy() / energy - 1);
    if (n * h < 2 * period && !(error <= early)) early = error;
    if (!(error <= all)) all = error;
    const double now = top.omega_body()[1];
    tumbles += before > 0 && now <= 0;
    before = now;
  }
  expect_at_most("largest relative error of the energy over two periods", "Eq. (2.11)", early, h * h, "(h ω)²",
                 "An explicit gyroscopic torque adds energy in every step.");
  expect_at_most("the same over 1e5 steps", "Eq. (2.11)", all, 1.05 * early + 1e5 * 16 * 2.3e-16,
                 "the band does not widen; 5 % for where the steps fall, and 1e5 steps of 16 roundings",
                 "The energy of a reversible step oscillates, but does not grow.");
  expect_near("number of whole periods, of two tumbles each, in 1e4 s", "Eq. (2.12)", tumbles, 1e4 / period,
              {5, "2 %, the effect of an error of a few (hω)² in the period"}, {}, "One period takes 39.1 s.");
}

}  // namespace
