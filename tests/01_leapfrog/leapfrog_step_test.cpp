// The step of a whole system: exact discrete solutions, order, energy, reversal.
#include "01_leapfrog/leapfrog.hpp"
#include "exercise_test.hpp"
#include "systems.hpp"

using namespace spook;
using namespace spook::testing;

namespace {

EXERCISE(HalfStepStart, "1.3 half_step_start");
EXERCISE(LeapfrogStep, "1.4 leapfrog_step");

void start_half_step_back(Particles& p, const ForceField& force, double h) {
  const std::vector<Vec3> x = p.x;
  for (std::size_t i = 0; i < x.size(); ++i)
    p.v[i] = half_step_start(p.v[i], force(i, x), p.inverse_mass[i], h);
}

EXERCISE_TEST(HalfStepStart, GivesOrderTwoOnAnOscillator) {
  const auto error = [](double h) {
    Particles p = oscillator();
    start_half_step_back(p, spring, h);
    const int steps = static_cast<int>(std::lround(10 / h));
    for (int n = 0; n < steps; ++n) leapfrog_step(p, spring, h);
    return std::abs(p.x[0].x() - std::cos(10.0));
  };
  expect_order("oscillator, |x - cos t| at t = 10 s", "Eq. (1.5), (1.10)", error, 0.05, 3, 2, 0.1,
               "Order 1 means that the velocity was not half a step back when the first kick came.");
}

EXERCISE_TEST(HalfStepStart, GivesOrderTwoOnAnOrbit) {
  const double period = 2 * std::acos(-1.0);
  const auto error = [&](double h) {
    Particles p = orbit();
    start_half_step_back(p, sun, h);
    const int steps = static_cast<int>(std::lround(period / 2 / h));
    for (int n = 0; n < steps; ++n) leapfrog_step(p, sun, h);
    // A whole period would hide a wrong start: it leaves the energy, and with it the period, nearly as it was.
    return (p.x[0] - Vec3(-1 - eccentricity, 0, 0)).norm();
  };
  expect_order("Kepler orbit, distance from the far end after half a period [m]", "Eq. (1.5), (1.10)", error,
               period / 400, 3, 2, 0.1,
               "Order 1 means that the velocity was not half a step back when the first kick came.");
}

EXERCISE_TEST(LeapfrogStep, FallsByTheExactDiscreteLaw) {
  const double g = 9.81, h = 0.02, mass = 3;
  const int n = 100;
  const ForceField weight = [&](std::size_t, const std::vector<Vec3>&) -> Vec3 { return {0, 0, -mass * g}; };
  Particles p{{Vec3::Zero()}, {Vec3::Zero()}, {1 / mass}};
  for (int k = 0; k < n; ++k) leapfrog_step(p, weight, h);
  expect_near(
      "height after 100 steps from rest [m]", "Eq. (1.7)", p.x[0].z(), -g * h * h * n * (n + 1) / 2,
      roundings(4 * n, 20),
      {{-g * h * h * n * (n - 1) / 2,
        "This is explicit Euler: it drifts with the old velocity. Kick first, then drift with the new one."},
       {-g * h * h * n * n / 2,
        "This is -g t²/2. Two half kicks a step are velocity Verlet, with v at the time of x. In this leapfrog "
        "v is half a step behind: take one whole kick, then the drift."},
       {0, "Nothing moved: is the drift missing, or was a copy kicked (auto v, where auto& v is meant)?"},
       {-g * h * h * n * (n + 1) / 4,
        "This is exactly half: each step has half a kick. Only the start takes "
        "half a step."},
       {-mass * g * h * h * n * (n + 1) / 2, "This is m times too much: the inverse mass has not been used."}},
      "From rest, x_n = -g h² n(n+1)/2, exactly.");
}

EXERCISE_TEST(LeapfrogStep, ComputesAllForcesAtOldPositions) {
  Random random;
  Particles p = three_bodies(random);
  const Particles old = p;
  const double h = 0.1;
  leapfrog_step(p, web, h);

  Particles right = old, body_by_body = old, euler = old;
  for (std::size_t i = 0; i < 3; ++i) {
    right.v[i] += h * old.inverse_mass[i] * web(i, old.x);
    right.x[i] += h * right.v[i];
    body_by_body.v[i] += h * old.inverse_mass[i] * web(i, body_by_body.x);
    body_by_body.x[i] += h * body_by_body.v[i];
    euler.x[i] += h * old.v[i];
  }
  expect_near_vector("x of the last of three coupled bodies after one step [m]", "Eq. (1.3), (1.4)", p.x[2],
                     right.x[2], roundings(16, 5),
                     {{body_by_body.x[2],
                       "Body by body: the force on the last body came from places to which the others had "
                       "already moved. Finish all kicks before the first drift."},
                      {euler.x[2], "This drifted with the velocity before the kick."},
                      {old.x[2], "The last body has not moved: does a loop end before it?"}});
  expect_near_vector("v of the last of three coupled bodies after one step [m/s]", "Eq. (1.3)", p.v[2],
                     right.v[2], roundings(16, 5),
                     {{body_by_body.v[2],
                       "Body by body: the force on the last body came from places to which the others had "
                       "already moved. Finish all kicks before the first drift."}});
  if (::testing::Test::HasFailure()) return;

  // A second step, from where the first has ended.
  const Particles between = p;
  leapfrog_step(p, web, h);
  const Tolerance close = roundings(16, 5);
  const Vec3 again = between.v[2] + h * between.inverse_mass[2] * web(2, between.x);
  const Vec3 old_forces = between.v[2] + h * between.inverse_mass[2] * web(2, old.x);
  if (!((p.v[2] - again).norm() <= close.value)) this_failure_explains();
  expect_near_vector(
      "v of the last of three coupled bodies after a second step [m/s]", "Eq. (1.3)", p.v[2], again, close,
      {{old_forces,
        "These are the forces of the first step: does a static variable keep them, or the "
        "positions? Ask for the forces in every step."}},
      "The first step was right, and this one is not. Does a static variable keep something of the "
      "first?");
}

EXERCISE_TEST(LeapfrogStep, GivesEachBodyItsOwnMass) {
  Random random;
  const double h = 0.1;
  const ForceField pull = [](std::size_t i, const std::vector<Vec3>&) -> Vec3 {
    return {1.0 + static_cast<double>(i % 10), 2, -3};
  };
  Particles p;
  for (int k = 0; k < 300; ++k) {
    p.x.push_back(k % 3 == 2 ? p.x.back() : random.vector());  // some are at the place of the one before
    p.v.push_back(random.vector());
    p.inverse_mass.push_back(k % 4 == 3 ? 0 : random.uniform(0.3, 2));
  }
  const Particles old = p;
  leapfrog_step(p, pull, h);
  for (std::size_t i = 0; i < p.x.size() && !::testing::Test::HasFailure(); ++i) {
    const auto with = [&](double inverse_mass) -> Vec3 { return old.v[i] + h * inverse_mass * pull(i, {}); };
    const std::string body =
        "body " + std::to_string(i) + " of 300, 1/m = " + show(old.inverse_mass[i]) + "/kg";
    expect_near_vector(
        "v of " + body + " [m/s]", "Eq. (1.3)", p.v[i], with(old.inverse_mass[i]), roundings(8, 5),
        {{i % 3 == 2 ? Vec3(old.v[i] + h * old.inverse_mass[i] * pull(i - 1, {})) : Vec3::Zero(),
          "This is the force on the body before, which is at the same place. Ask for each body's own force."},
         {with(old.inverse_mass[0]), "This used the mass of the first body. Each body has its own."},
         {Vec3::Zero(), "A body with 1/m = 0 keeps its velocity: no force changes it."}},
        "Each body has its own mass, and its own force.");
    expect_near_vector("x of " + body + " [m]", "Eq. (1.4)", p.x[i],
                       Vec3(old.x[i] + h * with(old.inverse_mass[i])), roundings(16, 5),
                       {{old.x[i], "It has not moved. A body with 1/m = 0 goes on with its velocity, too."}});
  }
}

EXERCISE_TEST(LeapfrogStep, ConservesMomentum) {
  Random random;
  Particles p = three_bodies(random);
  const auto momentum = [&] {
    Vec3 sum = Vec3::Zero();
    for (std::size_t i = 0; i < 3; ++i) sum += p.v[i] / p.inverse_mass[i];
    return sum;
  };
  const Vec3 before = momentum();
  const int steps = 1000;
  for (int n = 0; n < steps; ++n) leapfrog_step(p, web, 0.01);
  expect_near_vector(
      "momentum of three coupled bodies after 1000 steps [kg m/s]", "Eq. (1.3)", momentum(), before,
      roundings(16 * steps, 3), {},
      "The springs pull both ends alike. Momentum is lost when two bodies see different positions.");
}

EXERCISE_TEST(LeapfrogStep, KeepsTheOscillatorsInvariantForManySteps) {
  const double h = 0.5;
  Particles p = oscillator();
  start_half_step_back(p, spring, h);
  double first = 0, worst = 0;
  for (int n = 0; n < 20000; ++n) {
    const double x = p.x[0].x(), v_before = p.v[0].x();
    leapfrog_step(p, spring, h);
    const double invariant = (v_before * p.v[0].x() + x * x) / 2;
    if (n == 0) first = invariant;
    const double error = std::abs(invariant - first);
    if (std::isnan(error) || error > worst) worst = error;
  }
  expect_at_most(
      "change of ½ v_{n-1/2} v_{n+1/2} + ½ x_n² over 2e4 steps, h ω = 0.5 [J]", "Eq. (1.9)", worst,
      2e4 * 4 * 2.3e-16, "2e4 steps of 4 roundings",
      "Leapfrog conserves this exactly. Explicit Euler multiplies the energy by 1 + (hω)² each step.");
}

EXERCISE_TEST(LeapfrogStep, KeepsTheOrbitsEnergyInItsBandForManySteps) {
  const double h = 2 * std::acos(-1.0) / 200;
  Particles p = orbit();
  start_half_step_back(p, sun, h);
  double first_orbits = 0, all = 0;
  for (int n = 0; n < 20000; ++n) {
    const Vec3 x = p.x[0], v_before = p.v[0];
    leapfrog_step(p, sun, h);
    const Vec3 v = (v_before + p.v[0]) / 2;  // at the time of x: Eq. (1.6)
    const double error = std::abs(v.squaredNorm() / 2 - 1 / x.norm() + 0.5);
    if (std::isnan(error) || error > all) all = error;
    if (n < 1000) first_orbits = all;
  }
  expect_at_most("largest energy error of an orbit over 100 rounds, over that of the first 5", "Eq. (1.9)",
                 all / first_orbits, 1.05, "the band does not widen; 5 % for where in the orbit the steps fall",
                 "The energy error of leapfrog oscillates, but does not grow.");
  expect_at_most("largest energy error of the orbit, over its energy", "Eq. (1.9)", all / 0.5, 0.01,
                 "ten times (2π/200)², h² in units of the orbit");
}

EXERCISE_TEST(LeapfrogStep, RunsBackToWhereItCameFrom) {
  const double h = 0.05;
  const int steps = 1000;
  Particles p = orbit();
  start_half_step_back(p, sun, h);
  const Particles start = p;
  for (int n = 0; n < steps; ++n) leapfrog_step(p, sun, h);
  p.v[0] = -kick(p.v[0], sun(0, p.x), 1, h);  // the next kick, reversed
  for (int n = 0; n < steps; ++n) leapfrog_step(p, sun, h);
  expect_near_vector("x after 1000 steps forwards and 1000 backwards [m]", "Eq. (1.3), (1.4)", p.x[0],
                     start.x[0], {1e-9, "roundings, which grow with the square of the 2000 steps"}, {},
                     "Leapfrog is reversible. If yours is not, one of its lines mixes values of two times.");
}

EXERCISE_TEST(LeapfrogStep, RejectsAStepThatIsNotPositive) {
  Particles p = oscillator();
  leapfrog_step(p, spring, 0.1);
  for (const double h : {0.0, -0.1, std::nan(""), HUGE_VAL})
    expect_rejects(
        "h = " + show(h), "h", [&] { leapfrog_step(p, spring, h); },
        "See require_positive in common/require.hpp.",
        [&] {
          return std::vector<double>{p.x[0].x(), p.v[0].x()};
        });
  Particles nobody;
  expect_rejects(
      "h = 0, with no bodies", "h", [&] { leapfrog_step(nobody, spring, 0); },
      "Check h first: a step that makes no sense is refused even if there is nothing to move.");
}

}  // namespace
