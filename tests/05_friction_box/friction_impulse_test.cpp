// The friction impulse of one contact: by hand, at its bounds, and step by step.
#include "exercise_test.hpp"
#include "sliding.hpp"

using namespace spook;
using namespace spook::testing;

namespace {

EXERCISE(FrictionImpulse, "5.6 friction_impulse");

EXERCISE_TEST(FrictionImpulse, SolvesBothRowsByHand) {
  const Vec3 n(1, 0, 0);
  const Tangents t{Vec3(0, 1, 0), Vec3(0, 0, 1)};
  const Mat3 K = Vec3(9.5, 1.5, 3.5).asDiagonal();
  // Along t1: 3/(1.5 + 0.5); along t2: -2/(3.5 + 0.5). Along n there is no friction.
  expect_near_vector(
      "J [N s] for t1·Kt1 = 1.5, t2·Kt2 = 3.5, n·Kn = 9.5, Γ = 0.5, u = (7, -3, 2), Λ = 10", "Eq. (5.3)",
      friction_impulse(K, Vec3(7, -3, 2), t, 0.5, 10), Vec3(0, 1.5, -0.5), roundings(16, 2),
      {{Vec3(0, -1.5, 0.5), "The sign: this drives what slides. λ is against u."},
       {Vec3(0, 2, -2 / 3.5), "Γ is missing: divide by t·Kt + Γ."},
       {Vec3(0, 3, -2 / 3.0), "The sign of Γ: divide by t·Kt + Γ."},
       {Vec3(0, 6, -4), "K is missing: divide by t·Kt + Γ."},
       {Vec3(0, 3, -2), "This is -u along the tangents, in m/s. Divide by t·Kt + Γ."},
       {Vec3(0, 6, -8), "This multiplied by t·Kt + Γ. It is an inverse mass: divide by it."},
       {Vec3(0, 0.3, -0.2), "This has n·Kn in it. Along t the point moves by t·Kt."},
       {Vec3(0, 3 / (1 / 1.5 + 0.5), -2 / (1 / 3.5 + 0.5)),
        "This took t·Kt for a mass. It is an inverse mass."},
       {Vec3(-0.7, 1.5, -0.5), "This also stops the motion along the normal: that is the contact's own row."},
       {Vec3(0, 1.5, 0), "The row along t2 is missing."},
       {Vec3(0, 0, -0.5), "The row along t1 is missing."},
       {Vec3(0, 10, -10), "This is the bound at full strength. Friction takes no more than it needs to stop."},
       {Vec3(0, 10, 10), "This is the bound itself. Friction takes no more than it needs to stop."}},
      "J = λ1 t1 + λ2 t2, and (t·Kt + Γ) λ = -u·t along each.");
}

/// A contact anywhere, with t1·K t2 = 0: its two rows do not see each other. They do see the normal.
struct Touch {
  Tangents t;
  double k1, k2, p, q, k3;  ///< K in the frame of t1, t2, n
  Mat3 K;
  Vec3 u;

  explicit Touch(Random& random)
      : t(random_tangents(random)),
        k1(random.uniform(1, 3)),
        k2(random.uniform(1, 3)),
        p(random.uniform(-0.5, 0.5)),
        q(random.uniform(-0.5, 0.5)),
        k3(random.uniform(1, 3)),
        u(random.vector(2)) {
    Mat3 frame, within;
    frame << t.t1, t.t2, normal_of(t);
    within << k1, 0, p, 0, k2, q, p, q, k3;
    K = frame * within * frame.transpose();
  }
  std::string text() const { return "u·t1 = " + show(u.dot(t.t1)) + ", u·t2 = " + show(u.dot(t.t2)) + " m/s"; }
};

EXERCISE_TEST(FrictionImpulse, StopsThePointWhereItCan) {
  Random random;
  for (int trial = 0; trial < 200 && !::testing::Test::HasFailure(); ++trial) {
    const Touch touch(random);
    const Vec3 J = friction_impulse(touch.K, touch.u, touch.t, 0, 100), after = touch.u + touch.K * J;
    const Vec3 slip{after.dot(touch.t.t1), after.dot(touch.t.t2), J.dot(normal_of(touch.t))};
    expect_near("velocity left along t1, Γ = 0, Λ = 100 N s, for " + touch.text() + " [m/s]",
                "Eq. (5.2), (5.3)", slip[0], 0, roundings(64, 4),
                {{touch.u.dot(touch.t.t1), "Nothing has changed along t1."}},
                "Without softness and bound, friction leaves nothing of u·t.");
    expect_near("velocity left along t2, Γ = 0, Λ = 100 N s, for " + touch.text() + " [m/s]",
                "Eq. (5.2), (5.3)", slip[1], 0, roundings(64, 4),
                {{touch.u.dot(touch.t.t2), "Nothing has changed along t2."}},
                "Without softness and bound, friction leaves nothing of u·t.");
    expect_near("J·n [N s]", "Eq. (5.2)", slip[2], 0, roundings(64, 4), {},
                "Friction acts along the plane: J = λ1 t1 + λ2 t2 has no part along n.");
  }
}

// Along one tangent only: there the box and the cone of Coulomb agree.
EXERCISE_TEST(FrictionImpulse, KeepsItsBoundBothWays) {
  Random random;
  for (int trial = 0; trial < 20 && !::testing::Test::HasFailure(); ++trial) {
    const Touch touch(random);
    const double bound = random.log_uniform(1e-3, 1e-1), speed = random.uniform(1, 5);
    for (const Vec3& t : {touch.t.t1, touch.t.t2})
      for (const double sign : {1.0, -1.0}) {
        const Vec3 u = sign * speed * t + random.uniform(-1, 1) * normal_of(touch.t);
        const double needed = sign * speed / t.dot(touch.K * t);
        expect_near_vector(
            "J [N s] at a speed of " + show(sign * speed) + " m/s along one tangent, Λ = " + show(bound) +
                " N s",
            "Eq. (5.8)", friction_impulse(touch.K, u, touch.t, 0, bound), Vec3(-sign * bound * t),
            roundings(16, speed + 1),
            {{-needed * t, "The bound has not been kept: λ lies between -Λ and Λ."},
             {Vec3::Zero(),
              "λ has been kept between 0 and Λ, as a contact's. Friction acts both ways along t."},
             {sign * bound * t, "The sign: this drives what slides. λ is against u."}},
            "-Λ <= λ <= Λ, and against the motion.");
      }
  }
}

EXERCISE_TEST(FrictionImpulse, IsBoundedByABox) {
  Random random;
  for (int trial = 0; trial < 200 && !::testing::Test::HasFailure(); ++trial) {
    const Touch touch(random);
    const auto& [t1, t2] = touch.t;
    const double Gamma = random.uniform(0, 0.5);
    const double free1 = -touch.u.dot(t1) / (touch.k1 + Gamma), free2 = -touch.u.dot(t2) / (touch.k2 + Gamma);
    const double size = std::hypot(free1, free2), bound = size * random.uniform(0.3, 1.2);
    const Vec3 free = free1 * t1 + free2 * t2, u_t = touch.u.dot(t1) * t1 + touch.u.dot(t2) * t2;
    const Vec3 expected = std::clamp(free1, -bound, bound) * t1 + std::clamp(free2, -bound, bound) * t2;
    const std::string cone =
        "This is Coulomb's cone: J as a whole has been shortened to Λ. It is the better law, and the business "
        "of "
        "chapter 09. The box bounds λ1 and λ2 each for itself.";
    expect_near_vector("J [N s] for " + touch.text() + ", Λ = " + show(bound) + " N s", "Eq. (5.8)",
                       friction_impulse(touch.K, touch.u, touch.t, Gamma, bound), expected, roundings(64, 4),
                       {{free, "The bound has not been kept: λ lies between -Λ and Λ."},
                        {bound / size * free, cone},
                        {-bound * u_t.normalized(), cone}},
                       "Each λ by itself: -Λ <= λ1 <= Λ and -Λ <= λ2 <= Λ, whatever the other is.");
  }
}

EXERCISE_TEST(FrictionImpulse, TakesEachRowForItself) {
  const Tangents t{Vec3(1, 0, 0), Vec3(0, 1, 0)};
  Mat3 K;
  K << 2, 1, 0, 1, 4, 0, 0, 0, 3;
  expect_near_vector("J [N s] for t1·Kt1 = 2, t2·Kt2 = 4, t1·Kt2 = 1, Γ = 0, u = (-4, 6, 0), Λ = 10",
                     "Eq. (5.3)", friction_impulse(K, Vec3(-4, 6, 0), t, 0, 10), Vec3(2, -1.5, 0),
                     roundings(16, 3),
                     {{Vec3(22, -16, 0) / 7,
                       "This solves both rows together. The solver's sweeps do that: here each row is "
                       "solved as if the other were not there."},
                      {Vec3(2, -2, 0), "The second row has seen what the first did: here each is for itself."},
                      {Vec3(4 / 3.0, -6 / 5.0, 0),
                       "t·Kt is one number of K in the frame of the tangents, not the sum of a row."}},
                     "Each row for itself: λ = -u·t/(t·Kt).");
}

// Even where the rows see each other, t1·K t2 ≠ 0: of two rows solved side by side, each takes more energy than
// their meeting can give back.
EXERCISE_TEST(FrictionImpulse, NeverAddsEnergy) {
  Random random;
  for (int trial = 0; trial < 500 && !::testing::Test::HasFailure(); ++trial) {
    const Touch touch(random);
    const Mat3 mixed = touch.t.t1 * touch.t.t2.transpose();
    const Mat3 K = touch.K + random.uniform(-0.5, 0.5) * (mixed + mixed.transpose());
    const double Gamma = random.uniform(0, 1), bound = random.log_uniform(0.01, 10);
    const Vec3 J = friction_impulse(K, touch.u, touch.t, Gamma, bound);
    const double size = J.norm() * (touch.u.norm() + 4 * J.norm());
    // The work of J is J times the mean of u before and after.
    expect_at_most("energy that friction adds, for " + touch.text() + ", Λ = " + show(bound) + " N s [J]",
                   "Eq. (5.3), (5.8)", J.dot(touch.u + K * J / 2), roundings(64, size).value,
                   "friction only brakes; 64 roundings",
                   "Against the motion, and no more than stops it: then it takes energy, and never gives any.");
  }
}

EXERCISE_TEST(FrictionImpulse, IsNothingWithoutABound) {
  Random random;
  const Touch touch(random);
  expect_near_vector("J [N s] for Λ = 0", "Eq. (5.8)", friction_impulse(touch.K, touch.u, touch.t, 0.1, 0),
                     Vec3::Zero(), {0, "exact"}, {}, "Ice: -0 <= λ <= 0.");
}

EXERCISE_TEST(FrictionImpulse, IsNothingAtRest) {
  Random random;
  const Touch touch(random);
  expect_near_vector("J [N s] for u = 0", "Eq. (5.3)", friction_impulse(touch.K, Vec3::Zero(), touch.t, 0, 1),
                     Vec3::Zero(), {0, "exact"}, {},
                     "What is at rest needs no friction. Neither the sign of 0 nor u/|u| has a place here.");
}

EXERCISE_TEST(FrictionImpulse, KeepsANaN) {
  const Tangents t{Vec3(1, 0, 0), Vec3(0, 1, 0)};
  const double nan = std::nan("");
  const std::string clue =
      "std::min and std::max return their first argument when the other is NaN, and so made a number of it. "
      "std::clamp keeps a NaN.";
  const Mat3 one = Mat3::Identity();
  for (const Vec3& u : {Vec3(nan, 1, 0), Vec3(1, nan, 0)})
    expect_true("a velocity of NaN gives a J of NaN", "Eq. (5.8)", friction_impulse(one, u, t, 0, 0.5).hasNaN(),
                clue);
  expect_true("a K of NaN gives a J of NaN", "Eq. (5.8)",
              friction_impulse(nan * one, Vec3(1, 1, 0), t, 0, 0.5).hasNaN(), clue);
  expect_true("a Γ of NaN gives a J of NaN", "Eq. (5.8)",
              friction_impulse(one, Vec3(1, 1, 0), t, nan, 0.5).hasNaN(), clue);
}

// A block on a level floor, one step with a force along it.
struct Pushed {
  double m, h, Gamma, bound;
  Tangents t;
  Vec3 x = Vec3::Zero(), v = Vec3::Zero();

  void step(const Vec3& force) {
    v += h / m * force;
    v += friction_impulse(Mat3::Identity() / m, v, t, Gamma, bound) / m;
    x += h * v;
  }
};

EXERCISE_TEST(FrictionImpulse, LetsAStuckBlockCreepAtFOverC) {
  Random random;
  const double h = 1.0 / 60, m = 2, F = 5, c = 1e3, Gamma = 1 / (h * c);
  Pushed block{.m = m, .h = h, .Gamma = Gamma, .bound = 0.5 * m * 9.81 * h, .t = random_tangents(random)};
  const int steps = 10000;
  for (int n = 0; n < steps; ++n) block.step(F * block.t.t1);
  // It gets there by a factor r = mΓ/(1 + mΓ) a step: the sum of 1 - rⁿ over n is n - r/(1 - r).
  const double r = m * Gamma / (1 + m * Gamma), distance = h * F / c * (steps - r / (1 - r));
  expect_near(
      "distance of a stuck block after 10,000 steps, F = 5 N, c = 1000 N s/m [m]", "Eq. (5.4), (5.5)",
      block.x.dot(block.t.t1), distance,
      {steps * 2.3e-16 * (distance + 32 * h * h * F / m), "a rounding of it, and 32 of h² F/m, in each step"},
      {{0, "It does not creep: Γ is missing."}}, "It creeps at F/c, 5 mm/s.");
}

EXERCISE_TEST(FrictionImpulse, LetsAStuckBlockStayWhenRigid) {
  Random random;
  const double h = 1.0 / 60, m = 2, F = 9.8;
  Pushed block{.m = m, .h = h, .Gamma = 0, .bound = 0.5 * m * 9.81 * h, .t = random_tangents(random)};
  for (int n = 0; n < 10000; ++n) block.step(F * block.t.t2);
  expect_near("creep of a stuck block in 10,000 steps, F = 9.8 N of 9.81 N, Γ = 0 [m]", "Eq. (5.5)",
              block.x.dot(block.t.t2), 0, roundings(10000 * 16, h * h * F / m), {},
              "Stuck is stuck: friction makes up for exactly what the force adds, up to Λ.");
}

EXERCISE_TEST(FrictionImpulse, StopsASlidingBlock) {
  Random random;
  for (int trial = 0; trial < 20 && !::testing::Test::HasFailure(); ++trial) {
    const double h = random.log_uniform(0.001, 0.01), m = random.uniform(0.5, 3), A = random.uniform(1, 10);
    const double z = random.integer(20, 200) + random.uniform(-0.499, 0.499), v0 = z * A * h;
    Pushed block{.m = m, .h = h, .Gamma = 0, .bound = m * A * h, .t = random_tangents(random)};
    block.v = (v0 + A * h / 2) * block.t.t1;  // half a step early
    for (int n = 0; n < 400; ++n) block.step(Vec3::Zero());
    expect_near("distance of a block sent off at " + show(v0) + " m/s, μ g = " + show(A) +
                    " m/s², h = " + show(h) + " s [m]",
                "Eq. (5.10)", block.x.dot(block.t.t1), stopping_distance(v0, A, h),
                {1e-12 * z * v0 * h, "a few roundings of v in each of up to 400 steps, added up"}, {},
                "Full strength Λ until less is enough, then exactly that: it stops, and does not turn round.");
  }
}

}  // namespace
