// The asymmetric top I = (1, 2, 3), ω = (0.01, 1, 0.01): its period, and 1e5 steps of it.
#include "top.hpp"

using namespace spook;
using namespace spook::testing;

namespace {

EXERCISE(FreeRotation, "2.6 free_rotation");

/// Seconds between the first two times that ω_2 falls through 0, in body coordinates; NaN if it never does. There ω_2''
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
  return std::nan("");
}

EXERCISE_TEST(FreeRotation, HasTheTopsPeriod) {
  const double h = 0.005, period = tumbling_period();
  const std::string otherwise =
      "The distance to a top that never tumbles is 2e-4 of the energy, so the period shows the smallest "
      "mistake. "
      "NaN: it never tumbled.";
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
      "ω in body coordinates, off (-0.01, -1, 0.01) after half a period and off the start after one [rad/s]",
      "Eq. (2.12)", error, 0.1, 1e-10,
      "Half way through, axis 2 points the other way. With ω constant it never would.");
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
      "Each step hands on L by ω = I⁻¹ L, and the next gets it by L = I ω: with the same q? A q that is "
      "not normalised makes each of the two wrong by its length.");
  expect_near("|q| after 1e5 steps", "Eq. (2.11)", top.q.norm(), 1, roundings(16.0 * steps), {},
              "Turns are unit quaternions, so |q| = 1 but for roundings; normalise to take these away, too.");
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
                 "An explicit gyroscopic torque feeds the top at every step.");
  expect_at_most("the same over 1e5 steps", "Eq. (2.11)", all, 1.05 * early + 1e5 * 16 * 2.3e-16,
                 "the band does not widen; 5 % for where the steps fall, and 1e5 steps of 16 roundings",
                 "A reversible step swings in energy, but does not gain.");
  expect_near("times that it tumbled from head to foot in 1e4 s", "Eq. (2.12)", tumbles, 1e4 / period,
              {5, "2 %, as a period of a few (hω)² more or less makes"}, {}, "One a period of 39.1 s.");
}

}  // namespace
