// The friction impulse of one contact: by hand, at its bounds, and step by step.
#include "exercise_test.hpp"
#include "regions.hpp"
#include "relative_scales.hpp"
#include "sliding.hpp"

using namespace spook;
using namespace spook::testing;

namespace {

EXERCISE(FrictionImpulse, "5.6 friction_impulse");

EXERCISE_TEST(FrictionImpulse, SolvesBothRowsByHand) {
  const Vec3 n(1, 0, 0);
  const Tangents t{Vec3(0, 1, 0), Vec3(0, 0, 1)};
  const Mat3 K = Vec3(9.5, 1.5, 3.5).asDiagonal();
  const Vec3 u(7, -3, 2), J = friction_impulse(K, u, t, 0.5, 10);
  // One λ is positive, one negative. Where one is 0, the opposite motion distinguishes a missing row from a λ that is
  // bounded by 0.
  const bool one_sided = (J + friction_impulse(K, -u, t, 0.5, 10)).norm() > 0.1;
  const std::string both_ways = " side of 0 only, as a contact's. Friction pushes both ways along t.";
  // Along t1: 3/(1.5 + 0.5); along t2: -2/(3.5 + 0.5). Along n there is no friction.
  expect_near_vector(
      "J [N s] for t1·Kt1 = 1.5, t2·Kt2 = 3.5, n·Kn = 9.5, Γ = 0.5, u = (7, -3, 2), Λ = 10", "Eq. (5.3)", J,
      Vec3(0, 1.5, -0.5), roundings(16, 2),
      {{Vec3(0, -1.5, 0.5), "The sign: this accelerates a sliding body. λ is opposite to u."},
       {Vec3(0, 2, -2 / 3.5), "Γ is missing: divide by t·Kt + Γ."},
       {Vec3(0, 1.5, -1), "Both rows divide by t1·Kt1 + Γ. Along t2 the point moves by t2·Kt2."},
       {Vec3(0, 3, -2 / 3.0), "The sign of Γ: divide by t·Kt + Γ."},
       {Vec3(0, 6, -4), "K is missing: divide by t·Kt + Γ."},
       {Vec3(0, 3, -2), "This is -u along the tangents, in m/s. Divide by t·Kt + Γ."},
       {Vec3(0, 6, -8), "This multiplied by t·Kt + Γ. It is an inverse mass: divide by it."},
       {Vec3(0, 0.3, -0.2), "This has n·Kn in it. Along t the point moves by t·Kt."},
       {Vec3(0, 3 / (1 / 1.5 + 0.5), -2 / (1 / 3.5 + 0.5)),
        "This took t·Kt for a mass. It is an inverse mass."},
       {Vec3(-0.7, 1.5, -0.5), "This also stops the motion along the normal: that is the contact's own row."},
       {Vec3(-7 / 9.5, 2, -2 / 3.5),
        "This is -K⁻¹u in full, which also stops the motion along the normal. There is one division by t·Kt + "
        "Γ for each row."},
       {Vec3(0, 0.3, -1),
        "K(0, 0) and K(1, 1) belong to x and y, which here are n and t1. Along t it is t·Kt."},
       {Vec3(0, 1.5, 0), one_sided ? "λ is kept on the positive" + both_ways : "The row along t2 is missing."},
       {Vec3(0, 0, -0.5), one_sided ? "λ is kept on the negative" + both_ways : "The row along t1 is missing."},
       {Vec3(0, 10, -10), "This is always the full bound. Friction is no larger than needed to stop the slip."},
       {Vec3(0, 10, 10), "This is the bound itself. Friction is no larger than needed to stop the slip."}},
      "J = λ1 t1 + λ2 t2, and (t·Kt + Γ) λ = -u·t along each.");
}

EXERCISE_TEST(FrictionImpulse, DividesByKAlongEachTangent) {
  const Tangents t{Vec3(0.6, 0.8, 0), Vec3(-0.8, 0.6, 0)};
  Mat3 K;
  K << 2, 1, 0, 1, 4, 0, 0, 0, 3;
  const Vec3 u(-3.248, -2.864, 6);  // u·t1 = -4.24 and u·t2 = 0.88
  const auto divided_by = [&](double k1, double k2) -> Vec3 { return 4.24 / k1 * t.t1 - 0.88 / k2 * t.t2; };
  const Vec3 diagonal = K.diagonal();
  const auto along_axes = [&](const Vec3& tangent) { return tangent.dot(diagonal.cwiseProduct(tangent)); };
  const std::string axes =
      "K.diagonal() holds K along x, y and z. Along t it is t·Kt: one division by that for each row.";
  const std::string together =
      "This is -K⁻¹u, which stops all motion of the point. Divide by t·Kt once for each row.";
  const Vec3 full = -K.inverse() * u, one_by_one = -u.cwiseQuotient(diagonal);
  expect_near_vector(
      "J [N s] for t1 = (0.6, 0.8, 0), t2 = (-0.8, 0.6, 0), K = ((2, 1, 0), (1, 4, 0), (0, 0, 3)), Γ = 0, "
      "u = (-3.248, -2.864, 6), Λ = 10",
      "Eq. (5.3)", friction_impulse(K, u, t, 0, 10), divided_by(4.24, 1.76), roundings(32, 6),
      {{full, together},
       {Vec3(full.x(), full.y(), 0), together},
       {one_by_one, axes},
       {Vec3(one_by_one.x(), one_by_one.y(), 0), axes},
       {divided_by(along_axes(t.t1), along_axes(t.t2)), axes},
       {divided_by(diagonal.dot(t.t1), diagonal.dot(t.t2)), axes},
       {divided_by(diagonal.x(), diagonal.y()), axes},
       {divided_by((K * t.t1).norm(), (K * t.t2).norm()),
        "This divides by |Kt|, the whole change of velocity. The row needs its component along t, t·Kt."}},
      "t1·Kt1 = 4.24 and t2·Kt2 = 1.76: one division for each row.");
}

/// Any contact with t1·K t2 = 0: its two rows are not coupled to each other, but to the normal.
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
    const Vec3 full = -touch.K.inverse() * touch.u, n = normal_of(touch.t);
    const Vec3 after_full = touch.u + touch.K * (full - full.dot(n) * n);
    const std::string in_full =
        "This takes -K⁻¹u, which would stop the motion along the normal, too. One division by t·Kt for each "
        "row.";
    expect_near(
        "velocity left along t1, Γ = 0, Λ = 100 N s, for " + touch.text() + " [m/s]", "Eq. (5.2), (5.3)",
        slip[0], 0, roundings(64, 4),
        {{touch.u.dot(touch.t.t1), "Nothing has changed along t1."}, {after_full.dot(touch.t.t1), in_full}},
        "With Γ = 0 and λ inside its bounds, friction makes u·t zero.");
    expect_near(
        "velocity left along t2, Γ = 0, Λ = 100 N s, for " + touch.text() + " [m/s]", "Eq. (5.2), (5.3)",
        slip[1], 0, roundings(64, 4),
        {{touch.u.dot(touch.t.t2), "Nothing has changed along t2."}, {after_full.dot(touch.t.t2), in_full}},
        "With Γ = 0 and λ inside its bounds, friction makes u·t zero.");
    expect_near("J·n [N s]", "Eq. (5.2)", slip[2], 0, roundings(64, 4), {{full.dot(n), in_full}},
                "Friction acts along the plane: J = λ1 t1 + λ2 t2 has no part along n.");
  }
}

// Along one tangent only, where the box and Coulomb's cone agree.
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
            {{-needed * t, "λ exceeds its bound: it lies between -Λ and Λ."},
             {Vec3::Zero(),
              sign > 0 ? "λ has been kept between 0 and Λ, as a contact's. Friction acts both ways along t."
                       : "λ has been kept between -Λ and 0. Friction acts both ways along t."},
             {-sign * bound / 2 * t, "Half of the bound: λ may be as large as Λ either way, from -Λ to Λ."},
             {sign * bound * t, "The sign: this accelerates a sliding body. λ is opposite to u."}},
            "-Λ <= λ <= Λ, opposite to the motion.");
      }
  }
}

EXERCISE_TEST(FrictionImpulse, IsBoundedByABox) {
  Random random;
  Regions regions({"both rows stick", "λ1 at Λ", "λ1 at -Λ", "λ2 at Λ", "λ2 at -Λ", "both at a bound", "Λ = 0"},
                  20);
  while (regions.lack_draws()) {
    const Touch touch(random);
    const auto& [t1, t2] = touch.t;
    const double Gamma = random.uniform(0, 0.5);
    const double free1 = -touch.u.dot(t1) / (touch.k1 + Gamma), free2 = -touch.u.dot(t2) / (touch.k2 + Gamma);
    const double size = std::hypot(free1, free2), bound = size * std::max(0.0, random.uniform(-0.1, 1.2));
    const bool held1 = std::abs(free1) >= bound, held2 = std::abs(free2) >= bound;
    regions.draw({{"both rows stick", !held1 && !held2},
                  {"λ1 at Λ", free1 >= bound},
                  {"λ1 at -Λ", free1 <= -bound},
                  {"λ2 at Λ", free2 >= bound},
                  {"λ2 at -Λ", free2 <= -bound},
                  {"both at a bound", held1 && held2},
                  {"Λ = 0", bound == 0}});
    const Vec3 free = free1 * t1 + free2 * t2, u_t = touch.u.dot(t1) * t1 + touch.u.dot(t2) * t2;
    const Vec3 expected = std::clamp(free1, -bound, bound) * t1 + std::clamp(free2, -bound, bound) * t2;
    const std::string cone =
        "This is Coulomb's cone: It shortens the vector J to Λ. This law is better, and chapter 09 uses it. "
        "The "
        "box bounds λ1 and λ2 separately.";
    expect_near_vector("J [N s] for " + touch.text() + ", Λ = " + show(bound) + " N s", "Eq. (5.8)",
                       friction_impulse(touch.K, touch.u, touch.t, Gamma, bound), expected, roundings(64, 4),
                       {{free, "λ exceeds its bound: it lies between -Λ and Λ."},
                        {bound / size * free, cone},
                        {-bound * u_t.normalized(), cone}},
                       "-Λ <= λ1 <= Λ and -Λ <= λ2 <= Λ, each independently of the other.");
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
                       "This solves both rows together, which is the task of the solver's sweeps. Here solve "
                       "each row as if the other did not exist."},
                      {Vec3(2, -2, 0),
                       "The second row used the result of the first. Solve each from the same "
                       "u."},
                      {Vec3(4 / 3.0, -6 / 5.0, 0),
                       "t·Kt is one number of K in the frame of the tangents, not the sum of a row."}},
                     "Each row for itself: λ = -u·t/(t·Kt).");
}

// The numbers of SolvesBothRowsByHand with another speed: no speed is small enough to ignore.
EXERCISE_TEST(FrictionImpulse, IsProportionalToTheSlip) {
  const Tangents t{Vec3(0, 1, 0), Vec3(0, 0, 1)};
  const Mat3 K = Vec3(9.5, 1.5, 3.5).asDiagonal();
  for (const double slip : {1.0, 1e-3, 1e-6, 1e-9, 1e-12, 1e-15, 1e-30}) {
    const Vec3 u = slip * Vec3(7, -3, 2);
    const std::string text = "J [N s] for t1·Kt1 = 1.5, t2·Kt2 = 3.5, Γ = 0.5, u·t1 = " + show(-3 * slip) +
                             " m/s, u·t2 = " + show(2 * slip) + " m/s, Λ = ";
    const std::string small =
        "This slow slip, or this small bound, has been treated as 0. Even a slow slip adds up step by step, so "
        "stop it.";
    expect_near_vector(text + "10 N s", "Eq. (5.3)", friction_impulse(K, u, t, 0.5, 10),
                       Vec3(slip * Vec3(0, 1.5, -0.5)), roundings(16, 2 * slip),
                       {{Vec3::Zero(), small}, {Vec3(slip * Vec3(0, 1.5, 0)), small}},
                       "(t·Kt + Γ) λ = -u·t at any speed.");
    expect_near_vector(text + show(slip) + " N s", "Eq. (5.8)", friction_impulse(K, u, t, 0.5, slip),
                       Vec3(slip * Vec3(0, 1, -0.5)), roundings(16, 2 * slip),
                       {{Vec3::Zero(), small}, {Vec3(slip * Vec3(0, 1, 0)), small}}, "-Λ <= λ <= Λ for any Λ.");
    if (::testing::Test::HasFailure()) return;
  }
}

// Also for coupled rows, t1·K t2 ≠ 0: two rows solved independently remove more energy than their coupling can
// add.
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
                   "Friction opposes the motion and at most stops it, so it never adds energy.");
  }
}

EXERCISE_TEST(FrictionImpulse, IsNothingWithoutABound) {
  Random random;
  const Touch touch(random);
  expect_near_vector("J [N s] for Λ = 0", "Eq. (5.8)", friction_impulse(touch.K, touch.u, touch.t, 0.1, 0),
                     Vec3::Zero(), {0, "exact"}, {}, "Ice: -0 <= λ <= 0.");
  expect_near_vector("J [N s] for Λ = 0 and u = 0", "Eq. (5.8)",
                     friction_impulse(touch.K, Vec3::Zero(), touch.t, 0.1, 0), Vec3::Zero(), {0, "exact"}, {},
                     "A bound over an impulse is 0/0 here: clamp, do not divide.");
}

EXERCISE_TEST(FrictionImpulse, IsNothingAtRest) {
  Random random;
  const Touch touch(random);
  expect_near_vector("J [N s] for u = 0", "Eq. (5.3)", friction_impulse(touch.K, Vec3::Zero(), touch.t, 0, 1),
                     Vec3::Zero(), {0, "exact"}, {},
                     "A contact at rest needs no friction. Use neither the sign of 0 nor u/|u|.");
}

EXERCISE_TEST(FrictionImpulse, KeepsANaN) {
  const Tangents t{Vec3(1, 0, 0), Vec3(0, 1, 0)};
  const double nan = std::nan("");
  const Mat3 one = Mat3::Identity();
  const Vec3 u(1, 1, 0);
  for (const double bound : {0.5, 0.0}) {
    const std::string at = ", Λ = " + show(bound) + " N s";
    const std::string clue =
        bound > 0
            ? "std::min and std::max return their first argument when the other is NaN, so the NaN became "
              "a number. std::clamp keeps a NaN."
            : "Also for Λ = 0: a zero that is returned before u and K are used hides the NaN. std::clamp "
              "keeps it.";
    for (const Vec3& unknown : {Vec3(nan, 1, 0), Vec3(1, nan, 0)})
      expect_true("a velocity of NaN gives a J of NaN" + at, "Eq. (5.8)",
                  friction_impulse(one, unknown, t, 0, bound).hasNaN(), clue);
    expect_true("a K of NaN gives a J of NaN" + at, "Eq. (5.8)",
                friction_impulse(Mat3::Constant(nan), u, t, 0, bound).hasNaN(), clue);
    expect_true("a Γ of NaN gives a J of NaN" + at, "Eq. (5.8)",
                friction_impulse(one, u, t, nan, bound).hasNaN(), clue);
  }
  const std::string at_rest = "Also at rest: a zero that is returned before K and Γ are used hides the NaN.";
  expect_true("a K of NaN gives a J of NaN, u = 0", "Eq. (5.3)",
              friction_impulse(Mat3::Constant(nan), Vec3::Zero(), t, 0, 0.5).hasNaN(), at_rest);
  expect_true("a Γ of NaN gives a J of NaN, u = 0", "Eq. (5.3)",
              friction_impulse(one, Vec3::Zero(), t, nan, 0.5).hasNaN(), at_rest);
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
  // The difference from this speed shrinks by r = mΓ/(1 + mΓ) a step: the sum of 1 - rⁿ over n is n - r/(1 -
  // r).
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
              "It must not move: up to Λ, friction cancels exactly what the force adds.");
}

EXERCISE_TEST(FrictionImpulse, StopsASlidingBlock) {
  Random random;
  for (int trial = 0; trial < 20 && !::testing::Test::HasFailure(); ++trial) {
    const double h = random.log_uniform(0.001, 0.01), m = random.uniform(0.5, 3), A = random.uniform(1, 10);
    const double steps = random.integer(20, 200), z = steps + random.uniform(-0.499, 0.499), v0 = z * A * h;
    Pushed block{.m = m, .h = h, .Gamma = 0, .bound = m * A * h, .t = random_tangents(random)};
    block.v = (v0 + A * h / 2) * block.t.t1;  // half a step early
    for (int n = 0; n < 400; ++n) block.step(Vec3::Zero());
    expect_near("distance of a block sent off at " + show(v0) + " m/s, μ g = " + show(A) +
                    " m/s², h = " + show(h) + " s [m]",
                "Eq. (5.10)", block.x.dot(block.t.t1), stopping_distance(v0, A, h),
                {1e-12 * z * v0 * h, "a few roundings of v in each of up to 400 steps, added up"}, {},
                "λ is Λ until less is enough, and then exactly that. The block stops and does not reverse.");
  }
}

EXERCISE_TEST(FrictionImpulse, DropsNothingSmall) {
  const Tangents t{Vec3::UnitX(), Vec3::UnitY()};
  for (const double part : relative_scales)
    for (const bool first : {true, false}) {
      const Vec3 along = first ? t.t1 : t.t2, u = part * along + Vec3::UnitZ();
      expect_near_vector("J, for a slip of " + show(part) + " of the speed along the normal [N s]", "Eq. (5.3)",
                         friction_impulse(Vec3(2, 2, 3).asDiagonal(), u, t, 0, 10), Vec3(-part / 2 * along),
                         roundings(4, part), {{Vec3::Zero(), "There is none. " + small_is_dropped}},
                         small_is_dropped);
      if (::testing::Test::HasFailure()) return;
    }
  for (const double part : relative_scales)
    for (const Vec3& u : lopsided(part)) {
      expect_each_near<Vec3>("J, for a slip that is nearly along a tangent, or across both [N s]", "Eq. (5.3)",
                             friction_impulse(Vec3(2, 2, 3).asDiagonal(), u, t, 0, 10),
                             Vec3(-u[0] / 2, -u[1] / 2, 0), 4);
      if (::testing::Test::HasFailure()) return;
    }
  for (const double part : relative_scales)  // tangents that nearly lie along an axis
    for (const Vec3& leaning : lopsided(part)) {
      const Vec3 t1 = leaning.normalized(), n = t1.unitOrthogonal();
      expect_each_near<Vec3>("J, for a slip of 1 m/s along t1 [N s]", "Eq. (5.3)",
                             friction_impulse(2 * Mat3::Identity(), t1, {t1, n.cross(t1)}, 0, 10), -t1 / 2, 16);
      if (::testing::Test::HasFailure()) return;
    }
}

}  // namespace
