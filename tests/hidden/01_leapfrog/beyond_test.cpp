// Beyond chapter 01's own tests: steps that add up and go back, any size, many bodies.
#include "01_leapfrog/leapfrog.hpp"
#include "exercise_test.hpp"

using namespace spook;
using namespace spook::testing;

namespace {

EXERCISE(Kick, "1.1 kick");
EXERCISE(Drift, "1.2 drift");
EXERCISE(HalfStepStart, "1.3 half_step_start");
EXERCISE(LeapfrogStep, "1.4 leapfrog_step");
EXERCISE(ComposedStep, "1.5 composed_step");

EXERCISE_TEST(Kick, TwoShortOnesAreOneLong) {
  Random random;
  const Vec3 v = random.vector(5), f = random.vector(20);
  const double inverse_mass = random.log_uniform(0.1, 10);
  const double h1 = random.uniform(0.01, 0.1);
  const double h2 = random.uniform(-0.1, 0.1);
  const Vec3 got = kick(kick(v, f, inverse_mass, h1), f, inverse_mass, h2);
  expect_near_vector("v after two kicks [m/s]", "Eq. (1.3)", got, v + (h1 + h2) * inverse_mass * f,
                     roundings(16, v.norm() + inverse_mass * f.norm()));
}

EXERCISE_TEST(HalfStepStart, MakesAnyFreeFallExact) {
  Random random;
  const Vec3 x0 = random.vector(3), v0 = random.vector(5), f = random.vector(10);
  const double inverse_mass = random.uniform(0.5, 2);
  const double h = random.uniform(0.01, 0.1);
  const int n = random.integer(20, 60);
  Vec3 x = x0, v = half_step_start(v0, f, inverse_mass, h);
  for (int k = 0; k < n; ++k) {
    v = kick(v, f, inverse_mass, h);
    x = drift(x, v, h);
  }
  const double t = n * h;
  const double size = x0.norm() + t * v0.norm() + t * t * inverse_mass * f.norm();
  expect_near_vector("x after " + std::to_string(n) + " steps [m]", "Eq. (1.5)", x,
                     x0 + t * v0 + 0.5 * t * t * inverse_mass * f, roundings(4.0 * n, size));
}

EXERCISE_TEST(LeapfrogStep, GoesBackTheWayItCame) {
  Random random;
  const double k = random.uniform(1, 5), h = 0.05;
  const ForceField spring = [k](std::size_t i, const std::vector<Vec3>& x) -> Vec3 {
    return k * (x[1 - i] - x[i]);
  };
  const std::vector<Vec3> start = {random.vector(), random.vector()};
  Particles bodies{.x = start, .v = {random.vector(), random.vector()}, .inverse_mass = {1, 0.25}};
  const int n = random.integer(30, 60);
  for (int step = 0; step < n; ++step) leapfrog_step(bodies, spring, h);
  for (std::size_t i = 0; i < 2; ++i)  // the velocity after the next kick, turned around
    bodies.v[i] = -(bodies.v[i] + h * bodies.inverse_mass[i] * spring(i, bodies.x));
  for (int step = 0; step < n; ++step) leapfrog_step(bodies, spring, h);
  for (std::size_t i = 0; i < 2; ++i)
    expect_near_vector("x after as many steps back [m]", "Eq. (1.3), (1.4)", bodies.x[i], start[i],
                       roundings(200.0 * n, 10), {},
                       "All kicks first, by forces at the old positions; then all drifts.");
}

EXERCISE_TEST(ComposedStep, HasOrderFourForAnyFrequency) {
  Random random;
  const double omega = random.uniform(1, 2);
  for (const int pairs : {1, 2}) {
    const auto error = [&](double h) {
      Particles body{.x = {Vec3(1, 0, 0)}, .v = {Vec3::Zero()}, .inverse_mass = {1}};
      const auto steps = std::lround(1 / h);
      for (long k = 0; k < steps; ++k)
        composed_step(
            body, [omega](std::size_t i, const std::vector<Vec3>& x) -> Vec3 { return -omega * omega * x[i]; },
            h, pairs);
      return std::abs(body.x[0].x() - std::cos(omega));
    };
    expect_order("x after 1 s", "Eq. (1.13)", error, 0.1, 3, 4, 0.3);
  }
}

/// Expects at + part h rate, for large and small numbers, and for steps of both signs and of none.
void expect_moves(const std::string& what, const std::string& equation, double part,
                  const std::function<Vec3(const Vec3& at, const Vec3& rate, double h)>& move) {
  Random random;
  for (const double size : {1.0, 1e-15, 1e15})
    for (const double h : {0.3, -0.3, 1e-13, 0.0}) {
      const Vec3 at = random.vector(size), rate = random.vector(size);
      expect_near_vector(what, equation, move(at, rate, h), Vec3(at + part * h * rate), roundings(8, 2 * size));
    }
}

EXERCISE_TEST(Kick, IsRightForEverySizeAndStep) {
  for (const double inverse_mass : {4.0, 1e-8, 1e8})
    expect_moves("v after the kick [m/s]", "Eq. (1.3)", 1, [&](const Vec3& v, const Vec3& a, double h) {
      return kick(v, a / inverse_mass, inverse_mass, h);
    });
  expect_near_vector("v of a fixed body [m/s]", "Eq. (1.3)", kick(Vec3(1, 2, 3), Vec3(9, 9, 9), 0, 0.1),
                     Vec3(1, 2, 3), {0, "nothing is added"});
}

EXERCISE_TEST(Drift, IsRightForEverySizeAndStep) {
  expect_moves("x after the drift [m]", "Eq. (1.4)", 1, drift);
}

EXERCISE_TEST(HalfStepStart, IsRightForEverySizeAndStep) {
  for (const double inverse_mass : {4.0, 1e-8, 1e8})
    expect_moves("v half a step before [m/s]", "Eq. (1.5)", -0.5, [&](const Vec3& v, const Vec3& a, double h) {
      return half_step_start(v, a / inverse_mass, inverse_mass, h);
    });
}

/// Bodies of many masses; some are fixed.
Particles any_particles(Random& random) {
  Particles all;
  for (int k = 0; k < many; ++k) {
    all.x.push_back(random.vector());
    all.v.push_back(random.vector());
    all.inverse_mass.push_back(k % 9 == 0 ? 0 : random.log_uniform(1e-8, 1));
  }
  return all;
}

EXERCISE_TEST(LeapfrogStep, MovesManyBodiesThatPullAtEachOther) {
  Random random;
  const Particles before = any_particles(random);
  const ForceField pull = [](std::size_t i, const std::vector<Vec3>& x) -> Vec3 {
    return x[(i + 1) % x.size()] - x[i];
  };
  const double h = random.uniform(0.1, 0.3);
  Particles after = before;
  leapfrog_step(after, pull, h);
  for (std::size_t i = 0; i < before.x.size(); ++i) {
    const Vec3 v = before.v[i] + h * before.inverse_mass[i] * pull(i, before.x);
    expect_near_vector("v of body " + std::to_string(i) + " [m/s]", "Eq. (1.3)", after.v[i], v,
                       roundings(16, 4));
    expect_near_vector("x of body " + std::to_string(i) + " [m]", "Eq. (1.4)", after.x[i],
                       Vec3(before.x[i] + h * v), roundings(16, 4));
  }
}

EXERCISE_TEST(LeapfrogStep, RefusesAStepOfNoTime) {
  Random random;
  Particles all = any_particles(random), none;
  const ForceField pull = [](std::size_t, const std::vector<Vec3>& x) { return x[0]; };
  for (const double h : {0.0, -0.1, std::nan("")}) {
    expect_rejects(
        "h = " + std::to_string(h), "h", [&] { leapfrog_step(all, pull, h); }, "Look at h first.",
        [&] { return std::vector<double>(all.v[1].begin(), all.v[1].end()); });
    expect_rejects("h = " + std::to_string(h) + " without bodies", "h", [&] { leapfrog_step(none, pull, h); });
  }
}

EXERCISE_TEST(ComposedStep, IsExactUnderConstantForces) {
  Random random;
  const Particles before = any_particles(random);
  const Vec3 f = random.vector(3);
  const double h = random.uniform(0.1, 0.3);
  for (const int pairs : {1, 2, 3}) {
    Particles after = before;
    composed_step(
        after, [&](std::size_t, const std::vector<Vec3>&) { return f; }, h, pairs);
    for (std::size_t i = 0; i < before.x.size(); ++i) {
      const Vec3 a = before.inverse_mass[i] * f;
      expect_near_vector("v of body " + std::to_string(i) + " [m/s]", "Eq. (1.11)", after.v[i],
                         Vec3(before.v[i] + h * a), roundings(200, 4));
      expect_near_vector("x of body " + std::to_string(i) + " [m]", "Eq. (1.11)", after.x[i],
                         Vec3(before.x[i] + h * before.v[i] + h * h / 2 * a), roundings(200, 4));
    }
  }
}

}  // namespace
