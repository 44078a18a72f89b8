// The two impulses of Coulomb's friction, and the cone that decides between them.
#include "collisions.hpp"
#include "exercise_test.hpp"
#include "relative_scales.hpp"

using namespace spook;
using namespace spook::testing;

namespace {

EXERCISE(StickImpulse, "7.1 stick_impulse");
EXERCISE(InsideCone, "7.2 inside_cone");
EXERCISE(SlidingImpulse, "7.3 sliding_impulse");

EXERCISE_TEST(StickImpulse, OfASphereByHand) {
  // K⁻¹ = diag(2/7, 2/7, 1) m, and u' - u = (-1.4, 0.7, (1+e) 2) m/s.
  const double m = 3;
  const Vec3 u(1.4, -0.7, -2), n(0, 0, 1), J(-1.2, 0.6, 9);
  expect_near_vector(
      "J of a solid sphere of 3 kg, u = (1.4, -0.7, -2) m/s, on a plane with normal z, e = 0.5 [N s]",
      "Eq. (7.2), (7.3)", stick_impulse(K_of_sphere(m), u, n, 0.5), J, roundings(32, 10),
      {{Vec3(0, 0, 3), "This is K⁻¹ u'. An impulse makes the change of the velocity: from u to u'."},
       {K_of_sphere(m) * Vec3(-1.4, 0.7, 3),
        "This is K (u' - u). K is an inverse mass: K J is the change of velocity. Return J."},
       {Vec3(-1.2, 0.6, 3),
        "The sign of e: u·n is negative before, and u'·n = -e u·n must be positive, or the sphere goes on "
        "into the plane."},
       {Vec3(-1.2, 0.6, 6), "This stops the sphere, u' = 0: the restitution is missing."},
       {-J, "This is K⁻¹ (u - u'), the impulse on i. J is the one on j."},
       {Vec3(0, 0, 9),
        "This does not change the slip. A contact that sticks has no slip afterwards: u'_t = 0."},
       {Vec3(-1.8, 0.9, 9), "This is for u' = -e u, which reverses the slip, too. Restitution is along n."},
       {Vec3(-0.6, 0.3, 9), "The slip should vanish, u'_t = 0. This is for u'_t = e u_t."},
       {Vec3(-4.2, 2.1, 9),
        "This is m (u' - u). A push at its rim also turns the sphere, which makes the point easier to move: "
        "use "
        "K⁻¹."}},
      "u' = -e (u·n) n, then J = K⁻¹ (u' - u).");
}

EXERCISE_TEST(StickImpulse, LeavesTheRestitutionAndNoSlip) {
  Random random;
  for (int trial = 0; trial < 500 && !::testing::Test::HasFailure(); ++trial) {
    const Impact impact = random_impact(random);
    given() = impact.text();
    const auto& [K, u, n, e, mu] = impact;
    const Vec3 J = stick_impulse(K, u, n, e), u_after = u + K * J;
    expect_near_vector("u' = u + K J after an impact of two boxes [m/s]", "Eq. (7.2)", u_after, impact.wanted(),
                       impact.velocity_roundings(32, J),
                       {{u + impact.wanted(), "This is what K⁻¹ u' makes: J = K⁻¹ (u' - u)."},
                        {-impact.wanted(), "The sign of e: u·n is negative before, and u'·n positive."},
                        {Vec3::Zero(), "They stop: the restitution is missing."},
                        {-e * u, "The slip has been reversed, too: u'_t = 0."},
                        {u, "Nothing has changed."}},
                       "u'·n = -e u·n and u'_t = 0, for any K. All entries of K count: invert K, or solve with "
                       "it.");
  }
}

EXERCISE_TEST(StickImpulse, IsTheSameWhicheverBodyIsCalledI) {
  Random random;
  for (int trial = 0; trial < 100 && !::testing::Test::HasFailure(); ++trial) {
    const Impact impact = random_impact(random);
    given() = impact.text();
    const auto& [K, u, n, e, mu] = impact;
    expect_near_vector("J with i and j exchanged: -u for u, -n for n [N s]", "Eq. (7.3)",
                       stick_impulse(K, -u, -n, e), -impact.stick(), impact.impulse_roundings(32),
                       {{impact.stick(), "J must change its sign with u: it is the impulse on j."}},
                       "J is linear in u, and n enters twice.");
    expect_near_vector(
        "J of bodies that separate, -u for u [N s]", "Eq. (7.3)", stick_impulse(K, -u, n, e), -impact.stick(),
        impact.impulse_roundings(32), {{impact.stick(), "J must change its sign with u."}},
        "J is linear in u, also where u·n > 0: u'·n = -e u·n has a sign. Another function decides if there is "
        "an impact.");
  }
}

EXERCISE_TEST(StickImpulse, StopsAtZeroAndReversesAtOne) {
  const Mat3 K = K_of_rod();
  const Vec3 u(0.5, 0.25, -2), n(0, 0, 1);
  const Vec3 stopped = K * stick_impulse(K, u, n, 0), reversed = K * stick_impulse(K, u, n, 1);
  expect_near_vector("u' of a rod that hits the floor at 45°, e = 0 [m/s]", "Eq. (7.2)", Vec3(u + stopped),
                     Vec3::Zero(), roundings(64, 10), {{u, "Nothing has changed."}},
                     "Without restitution u' = 0.");
  expect_near_vector("u' of the same rod, e = 1 [m/s]", "Eq. (7.2)", Vec3(u + reversed), Vec3(0, 0, 2),
                     roundings(64, 10), {{-u, "The slip has been reversed, too: u'_t = 0."}},
                     "With e = 1 the approach is reversed in full, and the slip is gone.");
}

/// An impulse with |J_t| = slope J_n in some direction, J_n as given.
Vec3 leaning(Random& random, const Vec3& n, double slope, double J_n) {
  const Vec3 any = random.unit_vector();
  return J_n * n + slope * std::abs(J_n) * n.cross(any).normalized();
}

void expect_inside(const Vec3& J, const Vec3& n, double mu, bool inside, const std::string& clue) {
  expect_true("J = " + show(J) + " N s, n = " + show(n) + ", μ = " + show(mu) + " is " +
                  (inside ? "inside" : "outside"),
              "Eq. (7.4)", inside_cone(J, n, mu) == inside, clue);
}

EXERCISE_TEST(InsideCone, HasTheSlopeMu) {
  Random random;
  for (int trial = 0; trial < 200 && !::testing::Test::HasFailure(); ++trial) {
    const Vec3 n = random.unit_vector();
    const double mu = random.log_uniform(0.02, 5), J_n = random.log_uniform(1e-3, 1e3);
    expect_inside(leaning(random, n, 0.999 * mu, J_n), n, mu, true,
                  "|J_t| = 0.999 μ J_n here. J_t = J - (J·n) n, and its norm is compared with μ J_n.");
    expect_inside(leaning(random, n, 1.001 * mu, J_n), n, mu, false,
                  "|J_t| = 1.001 μ J_n here. J_t = J - (J·n) n, and its norm is compared with μ J_n.");
  }
}

EXERCISE_TEST(InsideCone, WidensWithMu) {
  const Vec3 n(0, 0, 1), steep(0, 0.8, 1), flat(0, 1.5, 1);
  expect_inside(steep, n, 0.5, false,
                "|J_t| = 0.8 J_n is more than μ J_n = 0.5 J_n: μ is missing, or inverted.");
  expect_inside(flat, n, 2, true, "|J_t| = 1.5 J_n is less than μ J_n = 2 J_n: μ is missing, or inverted.");
  expect_inside(Vec3(0, 0.9, 1), n, 1, true,
                "|J_t| = 0.9 J_n is less than μ J_n, though |J| is more: compare the tangential part.");
  expect_inside(Vec3(0, 0.55, 1), n, 0.5, false,
                "|J_t| = 0.55 J_n is more than μ J_n, though it is less than μ |J|: compare with the normal "
                "part.");
}

EXERCISE_TEST(InsideCone, IsAsWideAsMuSays) {
  for (const double mu : {1e-9, 1e-3, 1e3, 1e9}) {
    const std::string clue = "μ is any number from 0 on, however small or large.";
    expect_inside(Vec3(0, 0.9 * mu, 1), Vec3(0, 0, 1), mu, true, clue);
    expect_inside(Vec3(0, 1.1 * mu, 1), Vec3(0, 0, 1), mu, false, clue);
  }
}

EXERCISE_TEST(InsideCone, HasItsEdgeInside) {
  const std::string edge = "|J_t| = μ J_n exactly: the surface of the cone is inside, so use <= and not <.";
  expect_inside(Vec3(3, 4, 10), Vec3(0, 0, 1), 0.5, true, edge);
  expect_inside(Vec3(0.75, 1.5, 0), Vec3(0, 1, 0), 0.5, true, edge);
  expect_inside(Vec3(-2, 0, 0), Vec3(-1, 0, 0), 0, true, edge);
  for (const double mu : {0.0, 0.5})
    expect_inside(Vec3::Zero(), Vec3(0, 0, 1), mu, true,
                  "J = 0 is the tip of the cone: |J_t| = μ J_n = 0. Nothing pulls, as J·n is not negative.");
}

EXERCISE_TEST(InsideCone, HasNoSlack) {
  const Vec3 n(0, 0, 1);
  const std::string slack = "Compare |J_t| with μ J_n, without a tolerance, since impulses have any size.";
  // 1e-12 is far above the roundings of these numbers.
  for (const double size : {1.0, 1e-15, 1e15}) {
    expect_inside(size * Vec3(0.5 * (1 + 1e-12), 0, 1), n, 0.5, false,
                  "|J_t| is 1e-12 of it more than μ J_n here. " + slack);
    expect_inside(size * Vec3(0.5 * (1 - 1e-12), 0, 1), n, 0.5, true,
                  "|J_t| is 1e-12 of it less than μ J_n here. " + slack);
    expect_inside(size * Vec3(0, 0.8, 1), n, 0.5, false,
                  "|J_t| = 0.8 J_n is more than μ J_n = 0.5 J_n. " + slack);
    for (const double mu : {0.0, 0.5}) expect_inside(size * Vec3(0, 0, -1), n, mu, false, "It pulls. " + slack);
  }
}

EXERCISE_TEST(InsideCone, HasNoPullInside) {
  Random random;
  const std::string pull =
      "J·n is negative: it pulls. A comparison of squares, or |J·n|, does not notice this.";
  for (int trial = 0; trial < 100 && !::testing::Test::HasFailure(); ++trial) {
    const Vec3 n = random.unit_vector();
    const double mu = random.log_uniform(0.02, 5);
    expect_inside(leaning(random, n, 0.5 * mu, -random.log_uniform(1e-3, 1e3)), n, mu, false, pull);
  }
  expect_inside(Vec3(0, 0, -2), Vec3(0, 0, 1), 0.5, false, pull);
  expect_inside(
      Vec3(0, 0, -2), Vec3(0, 0, 1), 0, false,
      "It pulls straight along n. Then |J_t| = 0, and μ J_n is -0 for μ = 0: 0 <= -0 is true. Test J·n >= 0 as "
      "well.");
}

EXERCISE_TEST(InsideCone, IsALineWithoutFriction) {
  const Vec3 n(0, 0, 1);
  expect_inside(Vec3(0, 0, 3), n, 0, true, "Straight along n, there is no friction to ask for: 0 <= 0.");
  expect_inside(Vec3(1e-6, 0, 3), n, 0, false, "With μ = 0 no tangential part is allowed.");
}

EXERCISE_TEST(InsideCone, HasNoNaNInside) {
  const double NaN = std::nan("");
  const std::string clue =
      "Every comparison with NaN is false. Test for |J_t| <= μ J_n, not for the opposite of >.";
  expect_inside(Vec3(NaN, 0, 1), Vec3(0, 0, 1), 0.5, false, clue);
  expect_inside(Vec3(0, 0, NaN), Vec3(0, 0, 1), 0.5, false, clue);
  expect_inside(Vec3(0.1, 0, 1), Vec3(0, 0, 1), NaN, false, clue);
}

// Returns the impulse where there must be one. If there is none, the test fails and goes on with 0.
Vec3 value(const std::optional<Vec3>& J, double denominator,
           const std::string& clue = "Nothing is returned only when n·K(n - μt) <= 0, or NaN.") {
  expect_true("there is a sliding impulse, as n·K(n - μt) = " + show(denominator) + "/kg is positive",
              "Eq. (7.5)", J.has_value(), clue);
  return J.value_or(Vec3::Zero());
}

EXERCISE_TEST(SlidingImpulse, OfASphereByHand) {
  // K n = n/m: friction does not change the approach of a sphere. j = (1+e) m 2 m/s = 9 N s, t = (0.6, 0.8, 0).
  const double m = 3;
  const Vec3 u(3, 4, -2), n(0, 0, 1);
  expect_near_vector(
      "J of a solid sphere of 3 kg, u = (3, 4, -2) m/s, on a plane with normal z, e = 0.5, μ = 0.25 [N s]",
      "Eq. (7.5)", value(sliding_impulse(K_of_sphere(m), u, n, 0.5, 0.25), 1 / m), Vec3(-1.35, -1.8, 9),
      roundings(32, 10),
      {{Vec3(1.35, 1.8, 9), "This pushes along the slip. Friction opposes the slip: n - μt."},
       {Vec3(-0.9, -1.2, 6), "1 + e is missing: this is for e = 0."},
       {Vec3(-0.45, -0.6, 3), "This is for e instead of 1 + e: the approach must be stopped, too."},
       {Vec3(0, 0, 9), "The friction, -μ J_n t, is missing."},
       {Vec3(-5.4, -7.2, 9), "μ is missing in the friction, -μ J_n t."},
       {Vec3(-6.75, -9, 9),
        "t is a direction: divide u_t by its length. The friction does not depend on |u_t|."},
       {Vec3(-1.35, -1.8, 9) / 9, "This has been multiplied by n·K(n - μt): it is an inverse mass, divide."},
       {Vec3(1.35, 1.8, -9), "This is the impulse on i, or the sign of u·n: J pushes j along +n."}},
      "J_n = -(1+e) u·n / (n·K(n - μt)), then J = J_n n - μ J_n t.");
}

EXERCISE_TEST(SlidingImpulse, HasTheRestitutionWhateverK) {
  Random random;
  for (int trial = 0, met = 0; met < 300 && !::testing::Test::HasFailure(); ++trial) {
    Impact impact = random_impact(random);
    if (trial % 2 == 0)
      impact.mu /= 10;  // friction that changes the approach a little, and friction that dominates it
    given() = impact.text();
    const auto& [K, u, n, e, mu] = impact;
    const std::optional<Vec3> J = sliding_impulse(K, u, n, e, mu);
    if (impact.eased() < 0.02 * K.norm()) continue;  // J and its roundings grow without bound towards 0
    ++met;
    const double w = impact.approach(), nKn = n.dot(K * n), j = (1 + e) * w / nKn;
    expect_near(
        "u'·n = (u + K J)·n after an impact of two boxes [m/s]", "Eq. (7.2), (7.5)",
        n.dot(u + K * value(J, impact.eased())), e * w, impact.velocity_roundings(64, impact.slide()),
        {{-w + j * impact.eased(),
          "This divides by n·Kn. Friction changes the approach as well: the denominator is n·K(n - μt)."},
         {-w + (1 + e) * w / (2 * nKn - impact.eased()) * impact.eased(),
          "The denominator is n·K(n + μt): the same direction, n - μt, belongs in both places."},
         {0, "They do not separate: use 1 + e, not 1."},
         {-w, "Nothing has changed."}},
        "One N s along n and μ against t changes u·n by n·K(n - μt).");
  }
}

EXERCISE_TEST(SlidingImpulse, IsOnTheEdgeOfTheConeAgainstTheSlip) {
  Random random;
  for (int trial = 0, met = 0; met < 300 && !::testing::Test::HasFailure(); ++trial) {
    const Impact impact = random_impact(random);
    given() = impact.text();
    const auto& [K, u, n, e, mu] = impact;
    const std::optional<Vec3> got = sliding_impulse(K, u, n, e, mu);
    if (impact.eased() < 0.02 * K.norm()) continue;
    ++met;
    const Vec3 J = value(got, impact.eased()), t = impact.t();
    const double J_n = J.dot(n);
    const Vec3 J_t = J - J_n * n;
    expect_near_vector("J_t over J_n of two boxes that slide, against -μt", "Eq. (7.4), (7.5)", Vec3(J_t / J_n),
                       -mu * t, roundings(64 * impact.condition(), (1 + mu) * u.norm() / impact.slip().norm()),
                       {{mu * t, "This pushes along the slip. Friction opposes the slip: n - μt."},
                        {-t, "μ is missing in the friction, -μ J_n t."},
                        {-mu * impact.slip(), "t is a direction: divide u_t by its length."},
                        {Vec3::Zero(), "The friction, -μ J_n t, is missing."}},
                       "A contact that slides has the largest friction, |J_t| = μ J_n, against the slip.");
  }
}

EXERCISE_TEST(SlidingImpulse, IsAlongTheNormalWithoutFriction) {
  Random random;
  for (int trial = 0; trial < 20 && !::testing::Test::HasFailure(); ++trial) {
    Impact impact = random_impact(random);
    impact.mu = 0;
    given() = impact.text();
    const auto& [K, u, n, e, mu] = impact;
    const double nKn = n.dot(K * n), j = (1 + e) * impact.approach() / nKn;
    expect_near_vector("J of two boxes on ice, μ = 0 [N s]", "Eq. (7.5)",
                       value(sliding_impulse(K, u, n, e, mu), nKn), Vec3(j * n),
                       roundings(256 * impact.condition(), j), {}, "μ = 0 needs no special case: n - μt is n.");
  }
}

EXERCISE_TEST(SlidingImpulse, IsAlongTheNormalWithoutSlip) {
  const std::string rule =
      "Without slip t has no direction, and 0/0 is NaN: the friction is zero then, J = j n.";
  const auto J = sliding_impulse(K_of_rod(), Vec3(0, 0, -2), Vec3(0, 0, 1), 0.25, 0.5);
  expect_near_vector("J of a rod that comes straight down, u_t = 0 [N s]", "Eq. (7.5)", value(J, 2.5, rule),
                     Vec3(0, 0, 1), roundings(16), {}, rule);
  // |u_t| = 1e-12 |u| = 0: neither less nor more.
  const auto at_rest = sliding_impulse(K_of_rod(), Vec3::Zero(), Vec3(0, 0, 1), 0.25, 0.5);
  const std::string none = "At rest the slip is 0, and so is 1e-12 |u|: that is no slip, <= and not <. ";
  expect_near_vector("J of a rod at rest on the floor, u = 0 [N s]", "Eq. (7.5)",
                     value(at_rest, 2.5, none + rule), Vec3::Zero(), {0, "exact"}, {}, none + rule);
}

EXERCISE_TEST(SlidingImpulse, TreatsASlipOfRoundOffAsZero) {
  const std::string rule =
      "u_t is 1e-15 of u here, and its direction is round-off. A slip of up to 1e-12 |u| counts as none: J = j "
      "n.";
  const auto J = sliding_impulse(K_of_rod(), Vec3(2e-15, 0, -2), Vec3(0, 0, 1), 0.25, 0.5);
  const Vec3 by_noise(-5.0 / 13, 0, 10.0 / 13), forwards(5.0 / 7, 0, 10.0 / 7);  // n·K(n ∓ μt) = 2.5 ± 0.75
  expect_near_vector("J of a rod that comes down with a slip of the size of round-off [N s]", "Eq. (7.5)",
                     value(J, 2.5, rule), Vec3(0, 0, 1), roundings(16),
                     {{by_noise, "This is full friction, against round-off. " + rule},
                      {forwards,
                       "This is full friction, and forwards. Has it the wrong sign, or is it against the slip "
                       "that an impulse along n would leave? What counts is u_t, as it comes. " +
                           rule}},
                     rule);
  // The slip, 1e-9 m/s, is 1e-13 of u.
  const auto fast = sliding_impulse(K_of_rod(), Vec3(1e-9, 0, -1e4), Vec3(0, 0, 1), 0.25, 0.5);
  expect_near_vector("J of a rod that comes down at 10 km/s with a slip of 1e-9 m/s [N s]", "Eq. (7.5)",
                     value(fast, 2.5, rule), Vec3(0, 0, 5000), roundings(16, 5000),
                     {{5000 * by_noise,
                       "This is full friction, against round-off: compare |u_t| with |u|, not with a velocity "
                       "in m/s."}},
                     rule);
}

EXERCISE_TEST(SlidingImpulse, TakesASmallSlipForOne) {
  // n·K(n - μt) = 2.5 + 0.75, whatever the size of the slip.
  const Vec3 J(-5.0 / 13, 0, 10.0 / 13);
  for (const double slip : {1.0, 1e-4, 1e-8, 1e-11})
    expect_near_vector(
        "J of a rod that slips at " + show(slip) + " m/s and comes down at 2 m/s [N s]", "Eq. (7.5)",
        value(sliding_impulse(K_of_rod(), Vec3(slip, 0, -2), Vec3(0, 0, 1), 0.25, 0.5), 3.25), J, roundings(32),
        {{Vec3(0, 0, 1), "The friction is missing. Only a slip of up to 1e-12 |u| counts as none."}},
        "The friction depends on the slip's direction, not on how large it is.");
}

// Eq. (7.5) contains no fixed size: J is proportional to u and to the masses.
EXERCISE_TEST(SlidingImpulse, GrowsWithVelocitiesAndMasses) {
  const Vec3 u(1, 0, -2), n(0, 0, 1), J(-5.0 / 13, 0, 10.0 / 13), normal(0, 0, 1);
  for (const double size : {1e-13, 1e-9, 1e9, 1e13}) {
    expect_near_vector(
        "J of a rod, all velocities " + show(size) + " times as large [N s]", "Eq. (7.5)",
        value(sliding_impulse(K_of_rod(), size * u, n, 0.25, 0.5), 3.25), size * J, roundings(32, size),
        {{size * normal,
          "The friction is missing: the slip is half the approach. Compare |u_t| with |u|, not with m/s."}},
        "Twice the velocities, twice the impulse.");
    expect_near_vector("J of a rod of " + show(size) + " kg [N s]", "Eq. (7.5)",
                       value(sliding_impulse(K_of_rod() / size, u, n, 0.25, 0.5), 3.25 / size,
                             "The heavier the bodies, the smaller n·K(n - μt): any number above zero will do."),
                       size * J, roundings(32, size), {}, "Twice the masses, twice the impulse.");
  }
}

EXERCISE_TEST(SlidingImpulse, DoesNotExistWhereFrictionWins) {
  const Mat3 K = K_of_rod();
  const Vec3 n(0, 0, 1), ahead(-3, 0, -1), behind(3, 0, -1);  // t = -x, and t = x
  for (const double mu : {1.7, 2.0, 3.0, 5.0}) {
    expect_true("no sliding impulse of a rod at 45° pushed ahead of its end, n·K(n - μt) = 2.5 - 1.5 μ, μ = " +
                    show(mu),
                "Eq. (7.5)", !sliding_impulse(K, ahead, n, 0.5, mu).has_value(),
                "Friction turns the rod's end into the floor faster than the normal impulse lifts it. With a "
                "negative denominator J would pull.");
    value(sliding_impulse(K, behind, n, 0.5, mu), 2.5 + 1.5 * mu);
  }
  value(sliding_impulse(K, ahead, n, 0.5, 1.6), 0.1);
}

EXERCISE_TEST(SlidingImpulse, ExistsWhereTheDenominatorIsSmall) {
  // n·K(n - μt) = 2.5 - 1.25 μ, with μ just below 2.
  const Mat3 K = (Mat3() << 2.5, 0, -1.25, 0, 4, 0, -1.25, 0, 2.5).finished();
  for (const double part : relative_scales) {
    const double mu = 2 - part, eased = 2.5 - 1.25 * mu, j = 1.5 / eased;
    const auto J = sliding_impulse(K, Vec3(-4, 0, -1), Vec3(0, 0, 1), 0.5, mu);
    const std::string rule =
        "Such an impulse exists wherever the denominator is above zero, also where it is small and J is large.";
    expect_near_vector("J where n·K(n - μt) = " + show(eased) + " /kg, over j", "Eq. (7.5)",
                       Vec3(value(J, eased, rule) / j), Vec3(mu, 0, 1), roundings(16, 3 + 2.5 / eased), {},
                       rule);
    if (::testing::Test::HasFailure()) return;
  }
}

EXERCISE_TEST(SlidingImpulse, DoesNotExistWhereTheDenominatorIsZero) {
  // n·K(n - μt) = 2.5 - 2·1.25, all of it exact in floating point.
  const Mat3 K = (Mat3() << 2.5, 0, -1.25, 0, 4, 0, -1.25, 0, 2.5).finished();
  expect_true(
      "no sliding impulse where n·K(n - μt) = 0 exactly", "Eq. (7.5)",
      !sliding_impulse(K, Vec3(-4, 0, -1), Vec3(0, 0, 1), 0.5, 2).has_value(),
      "Then no impulse of this direction changes the approach, and j would be infinite: > 0, not >= 0.");
}

EXERCISE_TEST(SlidingImpulse, DoesNotComeOutOfANaN) {
  const double NaN = std::nan("");
  const Vec3 u(1, 0, -1), n(0, 0, 1);
  const std::string clue = "Every comparison with NaN is false: return J only where the denominator is > 0.";
  expect_true("no sliding impulse where K is NaN", "Eq. (7.5)",
              !sliding_impulse(Mat3::Constant(NaN), u, n, 0.5, 0.5).has_value(), clue);
  expect_true("no sliding impulse where μ is NaN", "Eq. (7.5)",
              !sliding_impulse(K_of_rod(), u, n, 0.5, NaN).has_value(), clue);
}

EXERCISE_TEST(StickImpulse, DropsNothingSmall) {
  for (const double part : relative_scales) {
    const Vec3 J = stick_impulse(Mat3::Identity(), Vec3(1, 0, -part), Vec3::UnitZ(), 0.5);
    expect_near("J·n of 1 kg that slips at 1 m/s, and approaches at " + show(part) + " of that [N s]",
                "Eq. (7.2), (7.3)", J.z(), 1.5 * part, roundings(8, part),
                {{part, "It has no restitution. " + small_is_dropped}, {0, small_is_dropped}},
                small_is_dropped);
    for (const Vec3& leaning : lopsided(part)) {
      const Vec3 n = leaning.normalized();
      expect_each_near<Vec3>("J of 1 kg that comes straight at 2 m/s, e = 0.5 [N s]", "Eq. (7.2), (7.3)",
                             stick_impulse(Mat3::Identity(), -2 * n, n, 0.5), 3 * n, 16);
    }
    if (::testing::Test::HasFailure()) return;
  }
}

EXERCISE_TEST(SlidingImpulse, DropsNothingSmall) {
  for (const double part : relative_scales)
    for (int c = 0; c < 3; ++c) {
      const Vec3 n = Vec3::Unit(c), ahead = Vec3::Unit((c + 1) % 3), aside = part * Vec3::Unit((c + 2) % 3);
      const Vec3 slip = ahead + aside;
      for (const double mu : {0.5, part, 1 / part})
        expect_each_near<Vec3>("J of 1 kg that comes at 1 m/s and slips at " + show(Eigen::MatrixXd(slip)) +
                                   " m/s, e = 0.5, μ = " + show(mu) + " [N s]",
                               "Eq. (7.5)", value(sliding_impulse(Mat3::Identity(), slip - n, n, 0.5, mu), 1),
                               1.5 * (n - mu * slip.normalized()), 16);
      expect_each_near<Vec3>(
          "J of 1 kg that slips at 1 m/s and comes at " + show(part) + " m/s, e = 0.5, μ = 0.5 [N s]",
          "Eq. (7.5)", value(sliding_impulse(Mat3::Identity(), ahead - part * n, n, 0.5, 0.5), 1),
          1.5 * part * (n - 0.5 * ahead), 16);
      if (::testing::Test::HasFailure()) return;
    }
}

}  // namespace
