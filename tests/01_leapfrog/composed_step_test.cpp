// Steps of order four, composed of leapfrog steps: the sum of the parts, the order, reversal, and energy.
#include "01_leapfrog/leapfrog.hpp"
#include "exercise_test.hpp"
#include "systems.hpp"

using namespace spook;
using namespace spook::testing;

namespace {

EXERCISE(ComposedStep, "1.5 composed_step");

const ForceField no_force = [](std::size_t, const std::vector<Vec3>&) -> Vec3 { return Vec3::Zero(); };

const double round_trip = 2 * std::acos(-1.0);

/// A clue for each order that a known mistake leads to.
const std::string cubes =
    "Order 2 means that the cubes of the parts do not add up to 0. Does w take the cube root of 2N, with the N "
    "of this call?";
const std::string not_symmetric =
    "Order 3 means that the cubes of the parts add up to 0, but the parts are not symmetric: take N of them, "
    "then the one backwards, then N again.";

const std::string one_place =
    "Order 1 means that all parts used the force at one place. Compute the force anew where each part begins.";

/// Returns the distance from the start after one round.
double error_of_a_round(double h, int pairs) {
  Particles p = orbit();
  const int steps = static_cast<int>(std::lround(round_trip / h));
  for (int n = 0; n < steps; ++n) composed_step(p, sun, h, pairs);
  return (p.x[0] - orbit().x[0]).norm();
}

EXERCISE_TEST(ComposedStep, TakesAFreeBodyOnByAWholeStep) {
  const double h = 0.3;
  for (const int pairs : {1, 2, 3}) {
    Particles p{{Vec3(1, 2, 3)}, {Vec3(4, 0, 0)}, {0.5}};
    try {
      composed_step(p, no_force, h, pairs);
    } catch (const std::invalid_argument& error) {
      report_failure(
          "a step of 0.3 s, pairs = " + show(pairs), "Eq. (1.11)",
          "  expected  no exception\n  got       one that says: " + std::string(error.what()) + "\n",
          "The part in the middle is negative, and leapfrog_step refuses such a step. kick and drift take "
          "steps of either sign.");
      return;
    }
    const double w = 1 / (2 * pairs - std::cbrt(2 * pairs));
    expect_near(
        "x of a free body at 4 m/s, from 1 m, after one step of 0.3 s, pairs = " + show(pairs) + " [m]",
        "Eq. (1.12)", p.x[0].x(), 2.2, roundings(20, 5),
        {{1 + 4 * h * (4 * pairs * w - 1),
          "The part in the middle went forwards. It is negative, since the other parts add up to more than h."},
         {1 + 4 * h * 2 * pairs * w,
          "The part in the middle is missing. Take `pairs` parts, then the middle "
          "one, then `pairs` parts again."},
         {1 + 4 * h / 2,
          "This is half a step. Each part drifts twice by half its length, before and after the "
          "kick."},
         {1, "Nothing moved."}},
        "The parts must add up to h.");
  }
}

EXERCISE_TEST(ComposedStep, IsExactInFreeFall) {
  const double g = 9.81, h = 0.1, mass = 3;
  const ForceField weight = [&](std::size_t, const std::vector<Vec3>&) -> Vec3 { return {0, 0, -mass * g}; };
  for (const int pairs : {1, 2}) {
    Particles p{{Vec3::Zero()}, {Vec3::Zero()}, {1 / mass}};
    for (int n = 0; n < 10; ++n) composed_step(p, weight, h, pairs);
    const double w = 1 / (2 * pairs - std::cbrt(2 * pairs)), w0 = 1 - 2 * pairs * w;
    const double squares = 2 * pairs * w * w + w0 * w0;
    const double late = -g * h * h * 10 * squares / 2;  // ½ g Σ (part)²
    expect_near(
        "height after falling from rest for 1 s, pairs = " + show(pairs) + " [m]", "Eq. (1.11)", p.x[0].z(),
        -g / 2, roundings(200, 20),
        {{-g / 2 + late,
          "Each part kicks and then drifts all the way: here v is of the time of x, so half the drift "
          "comes before the kick."},
         {-g / 2 - late, "Each part drifts all the way and then kicks: half the drift comes after the kick."},
         {-mass * g / 2, "This is m times too much: the inverse mass has not been used."}},
        "With a constant force (1.11) is exact, and so is any composition of it.");
    expect_near("v_z after falling for 1 s [m/s]", "Eq. (1.11)", p.v[0].z(), -g, roundings(200, 20), {},
                "The kicks of all parts must add up to h f/m.");
  }
}

EXERCISE_TEST(ComposedStep, HasOrderFourOnAnOscillator) {
  for (const int pairs : {1, 2}) {
    const auto error = [&](double h) {
      Particles p = oscillator();
      const int steps = static_cast<int>(std::lround(10 / h));
      for (int n = 0; n < steps; ++n) composed_step(p, spring, h, pairs);
      return std::abs(p.x[0].x() - std::cos(10.0));
    };
    expect_order("oscillator, |x - cos t| at t = 10 s, pairs = " + show(pairs), "Eq. (1.12), (1.13)", error,
                 0.2, 3, 4, 0.15, cubes, {{3, not_symmetric}, {1, one_place}});
  }
}

EXERCISE_TEST(ComposedStep, HasOrderFourOnAnOrbit) {
  for (const int pairs : {1, 2}) {
    const auto error = [&](double h) { return error_of_a_round(h, pairs); };
    expect_order(
        "Kepler orbit, distance from the start after one period [m], pairs = " + show(pairs),
        "Eq. (1.12), (1.13)", error, round_trip / 100, 3, 4, 0.2,
        "Order 2 means that the cubes of the parts do not add up to 0, or that all parts took their force "
        "from one place.",
        {{3, not_symmetric}, {1, one_place}});
  }
}

EXERCISE_TEST(ComposedStep, TakesAsManyPartsAsItIsAskedFor) {
  const double h = round_trip / 200;
  expect_at_most("error of five parts over that of three, on an orbit with 200 steps a round", "Eq. (1.13)",
                 error_of_a_round(h, 2) / error_of_a_round(h, 1), 0.1,
                 "the parts of the triple jump are three times as long, and the error is a high power of that "
                 "length",
                 "A ratio of 1 means that pairs was not used.");
}

// Calls with different numbers of pairs in turn. This shows parts that were kept from another call.
EXERCISE_TEST(ComposedStep, TakesThePartsOfThisCall) {
  const double h = 0.1;
  const auto by_hand = [&](int pairs, double w) {
    Particles p = oscillator();
    for (int n = 0; n <= 2 * pairs; ++n) {
      const double part = h * (n == pairs ? 1 - 2 * pairs * w : w);
      p.x[0] += part / 2 * p.v[0];
      p.v[0] -= part * p.x[0];
      p.x[0] += part / 2 * p.v[0];
    }
    return p.x[0].x();
  };
  const auto w_of = [](int pairs) { return 1 / (2 * pairs - std::cbrt(2 * pairs)); };
  for (const int pairs : {1, 2, 3, 5, 2, 1, 100}) {
    Particles p = oscillator();
    composed_step(p, spring, h, pairs);
    const std::string other =
        "The number of parts is right, but their length belongs to another number of pairs. Is it kept from an "
        "earlier call, in a static variable?";
    expect_near("x of an oscillator after a step of 0.1 s, pairs = " + show(pairs) + " [m]",
                "Eq. (1.11), (1.13)", p.x[0].x(), by_hand(pairs, w_of(pairs)), roundings(200),
                {{by_hand(pairs, w_of(pairs == 1 ? 2 : 1)), other},
                 {by_hand(pairs, w_of(pairs == 3 ? 2 : 3)), other},
                 {by_hand(pairs, w_of(5)), other}},
                "Each part has the length w h, and the middle one (1 - 2N w) h, with w of Eq. (1.13).");
    if (::testing::Test::HasFailure()) return;
  }
}

EXERCISE_TEST(ComposedStep, MovesEveryBody) {
  const double h = 0.1;
  Particles p{
      {Vec3(2, 0, 0), Vec3(1, 0, 0), Vec3(5, 6, 7)}, {Vec3::Zero(), Vec3(0, 3, 0), Vec3(1, 2, 3)}, {1, 0, 0}};
  for (int k = 3; k < 300; ++k) {  // and many more, every other one on a spring
    p.x.emplace_back(k, 6, 7);
    p.v.emplace_back(1, k, 3);
    p.inverse_mass.push_back(k % 2);
  }
  const Particles before = p;
  composed_step(p, spring, h, 2);
  for (std::size_t k = 1; k < before.x.size() && !::testing::Test::HasFailure(); ++k) {
    const Vec3 x = before.x[k], v = before.v[k];
    if (p.inverse_mass[k] > 0) {
      const Vec3 turned = std::cos(h) * v - std::sin(h) * x;
      expect_near_vector("velocity of body " + std::to_string(k) + " of 300, on a spring, after 0.1 s [m/s]",
                         "Eq. (1.11)", p.v[k], turned,
                         {std::pow(h, 5) * (x.norm() + v.norm()), "the error of a step of order four, h⁵"},
                         {{v, "It has not been kicked: a loop that ends early leaves the rest as they were."}},
                         "Every body is an oscillator by itself.");
      continue;
    }
    expect_near_vector(
        "x of body " + std::to_string(k) + ", of 1/m = 0, that moves at " + show(v) + " m/s, after 0.1 s [m]",
        "Eq. (1.11)", p.x[k], x + h * v, roundings(20, 10 + x.norm()),
        {{x, "It has not moved. A body with 1/m = 0 goes on with its velocity, too."}},
        "No force changes its velocity, and it drifts by h v.");
    expect_near_vector("its velocity [m/s]", "Eq. (1.3)", p.v[k], v, {0, "exact"}, {},
                       "With an inverse mass of 0 no force changes v.");
  }
}

EXERCISE_TEST(ComposedStep, ConservesMomentum) {
  Random random;
  Particles p = three_bodies(random);
  const auto momentum = [&] {
    Vec3 sum = Vec3::Zero();
    for (std::size_t i = 0; i < 3; ++i) sum += p.v[i] / p.inverse_mass[i];
    return sum;
  };
  const Vec3 before = momentum();
  const int steps = 100;
  for (int n = 0; n < steps; ++n) composed_step(p, web, 0.05, 2);
  expect_near_vector(
      "momentum of three coupled bodies after 100 steps [kg m/s]", "Eq. (1.3)", momentum(), before,
      roundings(100 * steps, 10), {},
      "The springs pull both ends alike. If you move body by body, the force on the second comes from the "
      "first's new place. Do all drifts, then all kicks, then all drifts.");
}

EXERCISE_TEST(ComposedStep, RunsBackToWhereItCameFrom) {
  const int steps = 300;
  Particles p = orbit();
  for (int n = 0; n < steps; ++n) composed_step(p, sun, 0.1, 2);
  p.v[0] = -p.v[0];
  for (int n = 0; n < steps; ++n) composed_step(p, sun, 0.1, 2);
  expect_near_vector("x after 300 steps forwards and 300 backwards [m]", "Eq. (1.11)", p.x[0], orbit().x[0],
                     {1e-9, "roundings, which grow with the square of the 600 steps"}, {},
                     "The parts must be symmetric: N of them, then the one backwards, then N again.");
}

EXERCISE_TEST(ComposedStep, KeepsTheOrbitsEnergyInItsBand) {
  const double h = round_trip / 60;
  Particles p = orbit();
  double first_orbits = 0, all = 0;
  for (int n = 0; n < 12000; ++n) {
    composed_step(p, sun, h, 2);
    const double error = std::abs(p.v[0].squaredNorm() / 2 - 1 / p.x[0].norm() + 0.5);
    if (std::isnan(error) || error > all) all = error;
    if (n < 600) first_orbits = all;
  }
  expect_at_most("largest energy error of an orbit over 200 rounds, over that of the first 10", "Eq. (1.11)",
                 all / first_orbits, 1.1, "the band does not widen; 10 % for where in the orbit the steps fall",
                 "The energy error of a composition of leapfrog steps stays bounded, too.");
}

EXERCISE_TEST(ComposedStep, RejectsAStepThatIsNotPositive) {
  Particles p = oscillator();
  composed_step(p, spring, 0.1, 2);
  for (const double h : {0.0, -0.1, std::nan(""), HUGE_VAL})
    expect_rejects(
        "h = " + show(h), "h", [&] { composed_step(p, spring, h, 2); },
        "See require_positive in common/require.hpp.",
        [&] {
          return std::vector<double>{p.x[0].x(), p.v[0].x()};
        });
}

EXERCISE_TEST(ComposedStep, RejectsLessThanOnePair) {
  Particles p = oscillator();
  composed_step(p, spring, 0.1, 1);
  for (const int pairs : {0, -1})
    expect_rejects(
        "pairs = " + show(pairs), "pairs", [&] { composed_step(p, spring, 0.1, pairs); },
        "See reject in common/require.hpp.",
        [&] {
          return std::vector<double>{p.x[0].x(), p.v[0].x()};
        });
}

}  // namespace
