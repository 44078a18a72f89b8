// Units of this chapter's arguments and results. The answers must be the same in any system of units.
#include "01_leapfrog/leapfrog.hpp"
#include "contract.hpp"
#include "exercise_test.hpp"

using namespace spook;
using namespace spook::testing;

namespace spook::testing {

static void each_number(Visitor& visitor, Particles& bodies, ByField) {
  using namespace units;
  each_number(visitor, bodies.x, m);
  each_number(visitor, bodies.v, m / s);
  each_number(visitor, bodies.inverse_mass, 1 / kg);
}

}  // namespace spook::testing

namespace {

EXERCISE(Kick, "1.1 kick");
EXERCISE(Drift, "1.2 drift");
EXERCISE(HalfStepStart, "1.3 half_step_start");
EXERCISE(LeapfrogStep, "1.4 leapfrog_step");
EXERCISE(ComposedStep, "1.5 composed_step");

const Vec3 x(2, -1, 0.5), v(-3, 0.25, 1), f(0.4, -7, 2);

EXERCISE_TEST(Kick, IsTheSameInAnyUnits) {
  using namespace units;
  expect_same_in_any_units("Eq. (1.3)", kick, m / s, v * (m / s), f * N, 0.3 * (1 / kg), 0.02 * s);
}

EXERCISE_TEST(Drift, IsTheSameInAnyUnits) {
  using namespace units;
  expect_same_in_any_units("Eq. (1.4)", drift, m, x * m, v * (m / s), 0.02 * s);
}

EXERCISE_TEST(HalfStepStart, IsTheSameInAnyUnits) {
  using namespace units;
  expect_same_in_any_units("Eq. (1.5)", half_step_start, m / s, v * (m / s), f * N, 0.3 * (1 / kg), 0.02 * s);
}

/// Two bodies on a spring between them, by one kind of step.
template <class Step>
auto on_a_spring(const Step& step) {
  return [step](Particles& moving, double stiffness, double h) {
    const ForceField pull = [&](std::size_t i, const std::vector<Vec3>& at) -> Vec3 {
      return stiffness * (at[1 - i] - at[i]);
    };
    step(moving, pull, h);
  };
}
const Particles two_bodies{.x = {x, f}, .v = {v, x}, .inverse_mass = {0.3, 2}};

EXERCISE_TEST(LeapfrogStep, IsTheSameInAnyUnits) {
  using namespace units;
  expect_same_in_any_units("Eq. (1.3), (1.4)", on_a_spring(leapfrog_step), nothing, two_bodies, 5 * (N / m),
                           0.02 * s);
}

EXERCISE_TEST(ComposedStep, IsTheSameInAnyUnits) {
  using namespace units;
  for (const int pairs : {1, 2, 5}) {
    const auto step = [pairs](Particles& p, const ForceField& pull, double h) {
      composed_step(p, pull, h, pairs);
    };
    if (!expect_same_in_any_units("Eq. (1.11)-(1.13)", on_a_spring(step), nothing, two_bodies, 5 * (N / m),
                                  0.02 * s))
      return;
  }
}

}  // namespace
