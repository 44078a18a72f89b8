// A sphere on a plane, step by step: its depth at rest, and its decay to that depth.
#include <complex>

#include "03_single_contact/single_contact.hpp"
#include "exercise_test.hpp"

using namespace spook;
using namespace spook::testing;

namespace {

EXERCISE(ContactImpulse, "3.4 contact_impulse");

constexpr double g = 9.81, mass = 2;

/// A sphere above (or in) a static plane. The contact is straight below its centre, so n·Kn = 1/m.
struct Sphere {
  double h, k, d;
  double gap, v = 0;
  double lambda = 0;
  SpookParameters spook = spook_parameters(h, k, d);

  double depth_at_rest() const { return mass * g / k; }  // Eq. (3.13)
  double deviation() const { return gap + depth_at_rest(); }
  double sigma() const { return 1 / (1 + mass * 4 / (h * h * k * (1 + 4 * d))); }  // S/(S + Σ), S = 1/m
  double beta() const { return 1 - 2 * (d + 1) * sigma() / (1 + 4 * d); }          // Eq. (3.14)
  double alpha() const { return 1 - 4 * d * sigma() / (1 + 4 * d); }
  std::string text() const { return "h = " + show(h) + " s, k = " + show(k) + " N/m, d = " + show(d); }

  /// The larger root of x² - 2βx + α = 0, as an absolute value.
  double decay() const {
    const std::complex<double> spread = std::sqrt(std::complex<double>(beta() * beta() - alpha()));
    return std::max(std::abs(beta() + spread), std::abs(beta() - spread));
  }

  void step() {
    lambda = contact_impulse(spook, 1 / mass, gap, v, -h * g);
    v += -h * g + lambda / mass;  // Eq. (3.12)
    gap += h * v;                 // Eq. (1.4)
  }
};

struct Setting {
  double h, k, d;
};
const std::vector<Setting> settings = {{1.0 / 30, 1e4, 2},  {1.0 / 60, 1e3, 0.5}, {1.0 / 60, 1e4, 3},
                                       {1.0 / 60, 1e6, 10}, {1.0 / 100, 1e4, 1},  {1.0 / 100, 1e5, 5},
                                       {1.0 / 240, 1e5, 4}, {1.0 / 1000, 1e6, 50}};

EXERCISE_TEST(ContactImpulse, StaysAtRest) {
  for (const auto& [h, k, d] : settings) {
    Sphere s{h, k, d, -mass * g / k};
    const double hmg = h * mass * g, lift = mass * s.spook.Sigma;  // Σ over n·Kn
    s.step();
    expect_near(
        "λ of a resting sphere, first step, " + s.text() + " [N s]", "Eq. (3.13)", s.lambda, hmg,
        roundings(16, hmg),
        {{hmg * (1 + lift), "Σ is missing: divide by n·Kn + Σ."},
         {hmg * lift / (1 + lift), "The force term is missing: λ must carry the weight of this very step."},
         {hmg * (1 - lift) / (1 + lift),
          "The gap counts with the wrong sign: the contact attracts. It is negative when penetrating."},
         {hmg / (1 + lift), "The gap is missing on the right side."}},
        "At rest the contact carries the weight: λ = h m g.");
    for (int n = 1; n < 1000; ++n) s.step();
    // In each step 16 roundings of λ change v by as many roundings of h g. Such an error decays within about 1
    // + d steps.
    expect_near("gap after 1000 steps at rest, " + s.text() + " [m]", "Eq. (3.13)", s.gap, -s.depth_at_rest(),
                roundings(16 * (1 + d), h * h * g + s.depth_at_rest()), {},
                "A sphere at gap = -mg/k, with v = 0, is at rest and stays there.");
    expect_near("λ after 1000 steps at rest, " + s.text() + " [N s]", "Eq. (3.13)", s.lambda, hmg,
                roundings(16 * (1 + d) * (1 + d), hmg), {},
                "At rest the contact carries the weight: λ = h m g.");
    if (::testing::Test::HasFailure()) return;
  }
}

EXERCISE_TEST(ContactImpulse, SettlesToADepthOfMgOverK) {
  for (const auto& [h, k, d] : settings) {
    Sphere s{h, k, d, 0};
    // With roots of size r at most, y_0 = mg/k and |y_1| <= 3 y_0, a linear recurrence of two terms has |y_n|
    // <= (1 + 4n/r) r^n y_0. Step until that is 1e-9, and once more, as λ depends on the step before.
    const double r = s.decay();
    int steps = 1;
    while ((1 + 4 * steps / r) * std::pow(r, steps) > 1e-9) ++steps;
    for (int n = 0; n <= steps; ++n) s.step();

    const double rest = -s.depth_at_rest(), hmg = h * mass * g;
    const std::string text = " after " + std::to_string(steps + 1) + " steps from touching, " + s.text();
    expect_near(
        "gap" + text + " [m]", "Eq. (3.13)", s.gap, rest,
        {1e-9 * s.depth_at_rest(), "1e-9 of mg/k, by the decay of Eq. (3.14)"},
        {{0, "It does not sink at all: Σ is missing. Divide by n·Kn + Σ."},
         {rest - h * h * g * (1 + 4 * d) / 4, "It is h² g (1 + 4d)/4 too deep: the force term is missing."}},
        "It rests at -mg/k, for any h and d.");
    expect_near("λ" + text + " [N s]", "Eq. (3.13)", s.lambda, hmg,
                {1e-9 * (1 + 2 * d) * hmg, "1e-9 of λ from the gap, 2d times that from the velocity"}, {},
                "At rest the contact carries the weight: λ = h m g.");
    if (::testing::Test::HasFailure()) return;
  }
}

EXERCISE_TEST(ContactImpulse, LetsAViolationDecayByItsRecurrence) {
  const double h = 1.0 / 60;
  for (const double d : {0.5, 1.0, 2.0, 3.0, 4.0, 5.0, 10.0})
    for (const double k : {1e3, 1e5, 1e12}) {
      // Within a tenth of h² g of rest, λ stays within 40 % of h m g, so the projection is not active.
      Sphere s{h, k, d, -mass * g / k - 0.1 * h * h * g};
      double y0 = s.deviation(), y1 = (1 - 4 * s.sigma() / (1 + 4 * d)) * y0;  // as v = 0 at first
      const Tolerance tolerance = roundings(32, h * h * g + s.depth_at_rest());
      s.step();
      expect_near("deviation from rest after one step, " + s.text() + " [m]", "Eq. (3.14)", s.deviation(), y1,
                  tolerance, {}, "From v = 0, the first step takes 4σ/(1 + 4d) of the deviation away.");
      y1 = s.deviation();
      for (int n = 2; n <= 50 && !::testing::Test::HasFailure(); ++n) {
        s.step();
        const double y2 = s.deviation();
        expect_near("deviation from rest at step " + std::to_string(n) + ", " + s.text() + " [m]", "Eq. (3.14)",
                    y2, 2 * s.beta() * y1 - s.alpha() * y0, tolerance, {},
                    "y_{n+2} = 2β y_{n+1} - α y_n, when a, b, Σ and n·Kn are used as in Eq. (3.10).");
        y0 = y1, y1 = y2;
      }
      if (::testing::Test::HasFailure()) return;
    }
}

EXERCISE_TEST(ContactImpulse, IsCriticalAtDTwo) {
  const double h = 1.0 / 60, k = 1e12, y0 = -0.1 * h * h * g;
  Sphere s{h, k, 2, -mass * g / k + y0};
  for (int n = 1; n <= 10 && !::testing::Test::HasFailure(); ++n) {
    s.step();
    // From v = 0 with the double root 1/3, as Σ -> 0: y_n = (1 + 2n/3) y_0 / 3^n.
    expect_near("deviation from rest at step " + std::to_string(n) + ", d = 2, k = 1e12 N/m [m]", "Eq. (3.14)",
                s.deviation(), (1 + 2.0 * n / 3) * y0 / std::pow(3, n),
                {1e-8 * std::abs(y0), "3 m Σ, how far σ is from 1: 3 · 3.2e-9"}, {},
                "d = 2 is critical: in the long run a third remains after each step, and nothing oscillates.");
  }
}

EXERCISE_TEST(ContactImpulse, LetsASphereLeave) {
  const double h = 1.0 / 60;
  Sphere s{h, 1e6, 3, 0};
  s.v = 3;  // upwards
  for (int n = 1; n <= 20; ++n) {
    s.step();
    expect_near("λ of a sphere thrown up from the plane, step " + std::to_string(n) + " [N s]", "Eq. (3.11)",
                s.lambda, 0, {0, "exact"}, {}, "The sphere moves away, and a contact never pulls.");
    if (::testing::Test::HasFailure()) return;
  }
  expect_near("height after 20 steps [m]", "Eq. (3.11)", s.gap, 3 * 20 * h - g * h * h * 20 * 21 / 2,
              roundings(80, 1), {},
              "Nothing but gravity acts on a sphere in the air: x_n = v t - g h² n(n+1)/2.");
}

}  // namespace
