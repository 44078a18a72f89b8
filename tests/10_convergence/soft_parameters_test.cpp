// The numbers of soft rows: closed forms, implicit Euler of an oscillator, and digits of very stiff and soft rows.
#include <numbers>

#include "exercise_test.hpp"
#include "random_input.hpp"
#include "systems.hpp"

using namespace spook;
using namespace spook::testing;

namespace {

EXERCISE(SoftParameters, "10.10 soft_parameters");

/// The frequency of a ω, in Hz.
double hertz(double omega) {
  return omega / (2 * std::numbers::pi);
}

EXERCISE_TEST(SoftParameters, AreThoseOfAFrequencyAndADampingRatio) {
  // h ω = 0.01 · 50 = 1/2 and 2ζ = 7/2, so h ω (2ζ + h ω) = 2.
  const SoftParameters soft = soft_parameters(0.01, hertz(50), 1.75);
  expect_near("bias_rate [1/s] of ω = 50/s, ζ = 1.75, h = 0.01 s", "Eq. (10.20)", soft.bias_rate, 12.5,
              roundings(10, 12.5),
              {{0.125, "This is h a. The bias rate is a, per second."},
               {hertz(50) / (3.5 + 0.01 * hertz(50)), "ω is 2π times the frequency."},
               {50 / (1.75 + 0.5), "It is 2ζ, not ζ."},
               {50 / 3.5, "h ω is missing in 2ζ + h ω."}});
  expect_near("mass_scale of the same", "Eq. (10.20)", soft.mass_scale, 2.0 / 3, roundings(10),
              {{1.0 / 3, "This is the impulse scale, Σ/(S + Σ)."},
               {2, "This is S/Σ. The mass scale is S/(S + Σ)."},
               {1.125 / 2.125, "It is 2ζ, not ζ."},
               {1.75 / 2.75, "h ω is missing in 2ζ + h ω."}});
  expect_near("impulse_scale of the same", "Eq. (10.20)", soft.impulse_scale, 1.0 / 3, roundings(10),
              {{2.0 / 3, "This is the mass scale, S/(S + Σ)."},
               {0.5, "This is Σ/S. The impulse scale is Σ/(S + Σ)."},
               {1 / 2.125, "It is 2ζ, not ζ."}});
}

EXERCISE_TEST(SoftParameters, AreSpooksAAndSigmaForAnyMass) {
  Random random;
  for (int trial = 0; trial < 100; ++trial) {
    const double h = random.log_uniform(1e-4, 0.1), f = random.log_uniform(0.1, 240),
                 zeta = random.log_uniform(0.01, 20), S = random.log_uniform(1e-3, 1e3);
    // The spring k and the relaxation d of Eq. (10.16), and implicit Euler of chapter 03.
    const double omega = 2 * std::numbers::pi * f, k = omega * omega / S, d = 2 * zeta / (h * omega);
    const double a = 1 / (h * (1 + d)), Sigma = 1 / (h * h * k * (1 + d));
    const SoftParameters soft = soft_parameters(h, f, zeta);
    const std::string row = " of a row with 1/S = " + show(1 / S, 4) + " kg";
    expect_near("a" + row + " [1/s]", "Eq. (10.16)", soft.bias_rate, a, roundings(30, a), {},
                "With k = ω²/S and d = 2ζ/(hω), a is 1/(h (1 + d)).");
    expect_near("S/(S + Σ)" + row, "Eq. (10.16)", soft.mass_scale, S / (S + Sigma),
                roundings(30, S / (S + Sigma)), {}, "With these k and d, Σ is 1/(h² k (1 + d)).");
    expect_near("Σ/(S + Σ)" + row, "Eq. (10.16)", soft.impulse_scale, Sigma / (S + Sigma),
                roundings(30, Sigma / (S + Sigma)), {}, "With these k and d, Σ is 1/(h² k (1 + d)).");
  }
}

EXERCISE_TEST(SoftParameters, SwingAsAnOscillatorDoes) {
  // A row alone: u <- (1 - σ) u - σ a g and g <- g + h u. With ζ = 1, from g = 1 at rest, g = (1 + ω t) e^(-ω t).
  const double omega = 3, end = 1;
  const auto error = [&](double h) {
    const SoftParameters soft = soft_parameters(h, hertz(omega), 1);
    double g = 1, u = 0;
    for (int n = 0; n < static_cast<int>(std::lround(end / h)); ++n) {
      u = soft.impulse_scale * u - soft.mass_scale * soft.bias_rate * g;
      g += h * u;
    }
    return std::abs(g - (1 + omega * end) * std::exp(-omega * end));
  };
  expect_order("gap of a critically damped row after 1 s", "Eq. (10.20)", error, 1.0 / 64, 4, 1, 0.1,
               "ζ = 1 is critical, and ω is 2π times the frequency.");
}

EXERCISE_TEST(SoftParameters, KeepTheDigitsOfStiffAndSoftRows) {
  // h ω = x and ζ = 0, so S/Σ = x². Beside 1, x² is round-off for x = 1e-9, and 1/x² for x = 1e9.
  for (const double x : {1e-9, 1e-3, 1e3, 1e9}) {
    const SoftParameters soft = soft_parameters(1, hertz(x), 0);
    expect_near("mass_scale for h ω = " + show(x), "Eq. (10.20)", soft.mass_scale, x * x / (1 + x * x),
                roundings(10, x * x / (1 + x * x)),
                {{1 - 1 / (1 + x * x),
                  "A very soft row loses all digits of 1 - impulse_scale. Compute each scale by itself."}});
    expect_near("impulse_scale for h ω = " + show(x), "Eq. (10.20)", soft.impulse_scale, 1 / (1 + x * x),
                roundings(10, 1 / (1 + x * x)),
                {{1 - x * x / (1 + x * x),
                  "A very stiff row loses all digits of 1 - mass_scale. Compute each scale by itself."}});
    expect_near("bias_rate for ζ = 0 [1/s]", "Eq. (10.20)", soft.bias_rate, 1, roundings(10), {},
                "Without damping a step closes the whole gap: a = 1/h.");
  }
}

EXERCISE_TEST(SoftParameters, AreRefused) {
  const double wrong[] = {-1, std::nan(""), infinity};
  for (const double value : wrong) {
    const std::string is = " = " + show(value) + ")";
    expect_rejects("soft_parameters(h" + is, "h", [&] { soft_parameters(value, 60, 1); });
    expect_rejects("soft_parameters(frequency" + is, "frequency", [&] { soft_parameters(0.01, value, 1); });
    expect_rejects("soft_parameters(damping" + is, "damping", [&] { soft_parameters(0.01, 60, value); });
  }
  expect_rejects("soft_parameters(h = 0)", "h", [] { soft_parameters(0, 60, 1); });
  expect_rejects("soft_parameters(frequency = 0)", "frequency", [] { soft_parameters(0.01, 0, 1); });
  expect_true("damping may be 0", "Eq. (10.20)", soft_parameters(0.01, 60, 0).bias_rate > 0);
}

}  // namespace
