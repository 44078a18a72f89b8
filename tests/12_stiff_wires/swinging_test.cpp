// Swinging, step by step with stiff_solve: a pendulum at any step, and a wire for which leapfrog alone is unstable.
#include "exercise_test.hpp"
#include "wires.hpp"

using namespace spook;
using namespace spook::testing;

namespace {

EXERCISE(StiffSolve, "12.4 stiff_solve");

EXERCISE_TEST(StiffSolve, SwingsAPendulumInStepsOfAnySize) {
  // M̃ makes 1 + h²g/l masses of one across the link, Eq. (12.9). 2/ω is 0.447 s.
  const double l = 0.5, angle = 1e-4;
  for (const double h : {0.02, 0.1, 0.3, 0.6, 2.0}) {
    const double q = h * h * gravity / l, turn = 2 * std::asin(std::sqrt(q / (1 + q)) / 2);
    Wire pendulum(1, l, 1, 2, angle, h);
    for (int n = 1; n <= 40 && !::testing::Test::HasFailure(); ++n) {
      expect_true("stiff_solve succeeds", "Eq. (12.6)", pendulum.step());
      const double start = l * std::sin(angle);
      expect_near(
          "amplitude of a pendulum of 0.5 m after " + std::to_string(n) + " steps of " + show(h) +
              " s, over the initial one",
          "Eq. (12.9)", pendulum.load().x() / start, std::cos(n * turn),
          {1e-5, "nonlinear terms at an angle of 1e-4: 1e-8 of it a step"}, {},
          "Across the link a mass m is m + h²T/l, and nothing is damped: cos(nθ), 4 sin²(θ/2) = q/(1+q), "
          "q = h²g/l.");
    }
  }
}

EXERCISE_TEST(StiffSolve, HoldsAWireOfAHundredLinks) {
  const double h = 1.0 / 60, mass = 0.01, length = 10, angle = std::numbers::pi / 6;
  for (const double ratio : {1e3, 1e5}) {
    const std::string wire =
        " of 100 links and " + show(ratio) + ":1, released at 30°, in 5 s of steps of 1/60 s";
    Wire swing(100, length, mass, ratio * mass, angle, h);
    const double scale = ratio * mass * gravity * length * (1 - std::cos(angle));
    double link = 0, gained = -infinity, side = infinity;
    for (int n = 0; n < 300; ++n) {
      if (!swing.step())
        throw std::logic_error("stiff_solve has returned false in step " + std::to_string(n + 1));
      link = std::max(link, swing.link_error());
      gained = std::max(gained, swing.gained());
      side = std::min(side, swing.load().x());
    }
    expect_at_most("largest error of a link, over its length" + wire, "Eq. (12.6)", link, 1e-3,
                   "the reference's error is 2.4e-4", "The wire has stretched.");
    expect_at_most("energy above the initial one, over m g l (1 - cos 30°)" + wire, "Eq. (12.6)",
                   gained / scale, 1e-9, "K does no net work, and SPOOK only dissipates",
                   "The energy has increased: does K have the right sign, and act on the right bodies?");
    expect_at_most("loss of energy, over the same" + wire, "Eq. (12.6)", -swing.gained() / scale, 5e-3,
                   "the reference's loss is 1.4e-3",
                   "Is there damping in it? K acts on the change of velocity, V + W_f.");
    expect_at_most("how far the load swings to the other side" + wire + " [m]", "Eq. (12.6)", side, -4.9,
                   "as far as it was at the start, 5 m", "It does not swing through.");
    if (::testing::Test::HasFailure()) return;
  }
}

EXERCISE_TEST(StiffSolve, IsOfSecondOrder) {
  // 2/ω is 1/114 s.
  const auto wire = [](double h) { return Wire(10, 10, 0.1, 100, std::numbers::pi / 6, h); };
  const auto place = [&](double h, bool (Wire::*step)()) {
    Wire swing = wire(h);
    for (int n = 0; n < std::lround(1 / h); ++n)
      if (!(swing.*step)())
        throw std::logic_error("the solve has returned false in step " + std::to_string(n + 1));
    return swing.load();
  };
  place(1.0 / 30, &Wire::step);
  const Vec3 right = place(1.0 / 1920, &Wire::step_without_stiffness);
  expect_order(
      "position of the load after 1 s, on 10 links and 1000:1 released at 30°, against chapter 11's in steps "
      "of 1/1920 s [m]",
      "Eq. (12.6)", [&](double h) { return (place(h, &Wire::step) - right).norm(); }, 1.0 / 30, 3, 2, 0.2,
      "A K that acts on the new velocity, Eq. (12.8), reduces the order to 1. Let it act on the change.");
}

}  // namespace
