// The soft step of other engines, in this course's numbers: Eq. (10.16), and chapters/ENGINES.md.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "04_gauss_seidel/gauss_seidel.hpp"
#include "random_input.hpp"

namespace spook::soft_step {

/// A row's frequency and damping ratio, its step and its inverse mass; and the three numbers that engines store for
/// them.
struct SoftStep {
  double omega, zeta, h, S;

  explicit SoftStep(testing::Random& random)
      : omega(2 * std::numbers::pi * random.log_uniform(0.1, 240)),
        zeta(random.log_uniform(0.01, 20)),
        h(random.log_uniform(1e-4, 0.1)),
        S(random.log_uniform(1e-3, 1e3)) {}

  double k() const { return omega * omega / S; }
  double d() const { return 2 * zeta / (h * omega); }
  double bias_rate() const { return omega / (2 * zeta + h * omega); }
  double impulse_scale() const { return 1 / (1 + h * omega * (2 * zeta + h * omega)); }
  double mass_scale() const { return h * omega * (2 * zeta + h * omega) * impulse_scale(); }

  /// Implicit Euler of chapter 03: b = 1.
  SpookParameters implicit_euler() const {
    return {.a = 1 / (h * (1 + d())), .b = 1, .Sigma = 1 / (h * h * k() * (1 + d()))};
  }
};

// A dozen operations each: 30 units of round-off of the larger number.
void expect_same(double got, double expected) {
  EXPECT_NEAR(got, expected, 30 * 2.3e-16 * std::abs(expected)) << "seed " << testing::Random::seed();
}

TEST(SoftStep, IsImplicitEulerOfChapterThree) {
  testing::Random random;
  for (int trial = 0; trial < 1000; ++trial) {
    const SoftStep soft(random);
    const SpookParameters implicit = soft.implicit_euler();
    expect_same(implicit.a, soft.bias_rate());
    expect_same(implicit.Sigma, soft.S / (soft.h * soft.omega * (2 * soft.zeta + soft.h * soft.omega)));
    expect_same(soft.S / (soft.S + implicit.Sigma), soft.mass_scale());
    expect_same(implicit.Sigma / (soft.S + implicit.Sigma), soft.impulse_scale());
  }
}

TEST(SoftStep, HasTheGapAndSoftnessOfSpookWithThreeQuartersMoreRelaxation) {
  testing::Random random;
  for (int trial = 0; trial < 1000; ++trial) {
    const SoftStep soft(random);
    const double d = soft.d();
    const SpookParameters implicit = soft.implicit_euler(),
                          spook = spook_parameters(soft.h, soft.k(), d + 0.75);
    expect_same(spook.a, implicit.a);
    expect_same(spook.Sigma, implicit.Sigma);
    expect_same(spook.b, (4 * d + 3) / (4 * d + 4));
  }
}

// One update, of a point mass 1/S above the floor, that has an impulse already.
TEST(SoftStep, UpdatesARowAsChapterFourDoes) {
  testing::Random random;
  const Twist<3> up(0, 0, 1);
  for (int trial = 0; trial < 1000; ++trial) {
    const SoftStep soft(random);
    const double gap = -random.uniform(0, 0.01), speed = random.uniform(-1, 1),
                 press = random.uniform(0, 2) / soft.S;
    const Motion<3> motion{.inverse_mass = {{.linear = 0}, {.linear = soft.S}},
                           .W = {Twist<3>::Zero(), speed * up},
                           .Wf = {Twist<3>::Zero(), Twist<3>::Zero()}};
    Row<3> row = make_row<3>(
        {.i = 0, .j = 1, .Gi = -up, .Gj = up, .gap = gap, .spook = soft.implicit_euler(), .lo = -infinity},
        motion);
    std::vector<Twist<3>> V(2, Twist<3>::Zero());
    row.lambda = press;
    V[1] = press * row.MinvGj;
    const double u = speed + V[1].z(), normal_mass = 1 / soft.S;
    const double change =
        -normal_mass * soft.mass_scale() * (u + soft.bias_rate() * gap) - soft.impulse_scale() * press;
    const double got = update_row(row, V);
    // Sums of numbers of about 3/S, which may cancel.
    EXPECT_NEAR(got, change, 100 * 2.3e-16 * (3 + soft.bias_rate() * std::abs(gap)) / soft.S)
        << "seed " << testing::Random::seed();
  }
}

}  // namespace spook::soft_step
