// The work of an impulse, and an impulse that never adds energy.
#include "collisions.hpp"
#include "exercise_test.hpp"
#include "relative_scales.hpp"

using namespace spook;
using namespace spook::testing;

namespace {

EXERCISE(ImpactWork, "7.4 impact_work");
EXERCISE(SafeImpulse, "7.5 safe_impulse");

// Every known mistake gives another number, if J·u and J·KJ are chosen so.
void expect_work(const Vec3& u, const Vec3& J, double expected, const std::string& numbers) {
  const Mat3 K = Vec3(2, 1, 0.5).asDiagonal();
  const double Ju = J.dot(u), JKJ = J.dot(K * J), inverted = J.dot(K.inverse() * J);
  expect_near(
      "ΔE for K = diag(2, 1, 0.5)/kg, u = " + show(u) + " m/s, J = " + show(J) + " N s, " + numbers + " [J]",
      "Eq. (7.6)", impact_work(K, u, J), expected, roundings(16, 20),
      {{Ju + JKJ,
        "½ is missing: the point moves at u at first and at u + K J at last, on average at u + ½ K J."},
       {(Ju + JKJ) / 2, "This is ½ J·(u + K J): ½ is in the wrong place. It belongs to K J alone."},
       {(Ju + JKJ / 2) / 2, "This is (J·u + ½ J·KJ)/2: ½ belongs to K J alone, u counts in full."},
       {Ju, "This is J·u. The velocity changes while J acts: by ½ K J on average. (In C++, 1 / 2 is 0.)"},
       {JKJ / 2, "This is ½ J·KJ. The velocity of before, u, counts, too."},
       {JKJ, "This is J·KJ. The velocity of before, u, counts, too, and of the change K J one half."},
       {Ju - JKJ / 2, "The sign of K J: J changes the velocity by + K J."},
       {-expected, expected > 0
                       ? "The sign of ΔE: it is what J adds to the energy."
                       : "The sign of ΔE: energy is lost here, and that is less than zero. No absolute value."},
       {JKJ / 2 - Ju, "The sign of u: J·u is negative here, J acts against the motion."},
       {Ju + inverted / 2, "K is an inverse mass: multiply J by it, don't solve with it."}},
      "Force times the average velocity of the point: J·(u + ½ K J).");
}

EXERCISE_TEST(ImpactWork, ByHand) {
  expect_work({1, 0, -3}, {3, 0, 2}, 7, "-3 + 20/2");
  if (::testing::Test::HasFailure()) return;
  expect_work({1, 0, -3}, {1, 0, 2}, -3, "-5 + 4/2");
}

EXERCISE_TEST(ImpactWork, IsTheChangeOfKineticEnergyOfTwoBoxes) {
  Random random;
  for (int trial = 0; trial < 200 && !::testing::Test::HasFailure(); ++trial) {
    Boxes pair(random, 2);
    const Contact contact = pair.contact(random, 0, 1);
    const Mat3 K = pair.K(contact);
    const Vec3 u = pair.velocity(contact, 0), J = random.vector(3);
    given() = "given K = " + show(Eigen::MatrixXd(K)) + "/kg, u = " + show(u) + " m/s, J = " + show(J) + " N s";
    const double work = impact_work(K, u, J), before = pair.kinetic_energy(0);
    apply_impact(contact, J, pair.motion);
    const double after = pair.kinetic_energy(0);
    expect_near("ΔE of two solid boxes by any impulse at all [J]", "Eq. (7.6)", work, after - before,
                roundings(500, before + after),
                {{J.dot(u + K * J), "½ is missing: J·(u + ½ K J)."},
                 {J.dot(u + K * J) / 2, "½ is in the wrong place: it belongs to K J alone."},
                 {J.dot(u), "The velocity changes while J acts: by ½ K J on average."},
                 {J.dot(u + Mat3(K.triangularView<Eigen::Upper>()) * J / 2),
                  "This reads the upper triangle of K alone. All nine entries count."},
                 {J.dot(u + Vec3(K.diagonal().cwiseProduct(J)) / 2),
                  "This reads the diagonal of K alone. All nine entries count."},
                 {before - after, "The sign: what is added to the energy, + when they get faster."}},
                "Against ½ m v² + ½ ω·Iω of both boxes, before and after.");
  }
}

EXERCISE_TEST(ImpactWork, IsTheChangeOfKineticEnergyOfTwoPointMasses) {
  Random random;
  for (int trial = 0; trial < 50 && !::testing::Test::HasFailure(); ++trial) {
    const double m_i = random.log_uniform(0.1, 10), m_j = random.log_uniform(0.1, 10);
    const Vec3 v_i = random.vector(), v_j = random.vector(), J = random.vector(2);
    const Mat3 K = (1 / m_i + 1 / m_j) * Mat3::Identity();
    const double work = impact_work(K, v_j - v_i, J);
    const double before = (m_i * v_i.squaredNorm() + m_j * v_j.squaredNorm()) / 2;
    const double after = (m_i * (v_i - J / m_i).squaredNorm() + m_j * (v_j + J / m_j).squaredNorm()) / 2;
    expect_near("ΔE of point masses of " + show(m_i) + " and " + show(m_j) + " kg [J]", "Eq. (7.6)", work,
                after - before, roundings(64, before + after), {}, "Against ½ m v² of both, before and after.");
  }
}

EXERCISE_TEST(ImpactWork, OfACentralImpactIsWhatRestitutionLoses) {
  const double m = 4, w = 3;  // m = m_i m_j/(m_i + m_j), K = 1/m
  for (const double e : {0.0, 0.5, 1.0})
    expect_near("ΔE of a central impact at 3 m/s, reduced mass 4 kg, e = " + show(e) + " [J]", "Eq. (7.6)",
                impact_work(Mat3::Identity() / m, Vec3(0, 0, -w), Vec3(0, 0, (1 + e) * m * w)),
                -m * w * w * (1 - e * e) / 2, roundings(32, 40), {},
                "-½ (1 - e²) m w²: all of it for e = 0, nothing for e = 1.");
}

EXERCISE_TEST(SafeImpulse, OfASphereByHand) {
  // P = m w n, Q - P = -2/7 m u_t: κ = 7/2 μ (1+e) w/|u_t|, at most 1. 2/7 m |u_t| = 3 N s, (1+e) m w = 9 N s.
  const double m = 3;
  const Vec3 u(2.1, 2.8, -2), n(0, 0, 1), t(0.6, 0.8, 0);
  const std::string what = "J of a solid sphere of 3 kg, u = (2.1, 2.8, -2) m/s, on a plane, e = 0.5, μ = ";
  expect_near_vector(
      what + "0.25 [N s]", "Eq. (7.7), (7.8)", safe_impulse(K_of_sphere(m), u, n, 0.5, 0.25), 9 * n - 2.25 * t,
      roundings(64, 10),
      {{9 * n, "This is κ = 0, without friction. Eq. (7.8) wants the largest κ in the cone: here 3/4."},
       {9 * n - 3 * t, "This is κ = 1, which leaves the cone: |J_t| = 3 N s, and μ J_n = 2.25 N s."},
       {9 * n - 1.5 * t, "The cone has been taken at P, not at J: J·n contains 1 + e."},
       {6 * n - 2.25 * t, "This is for e = 0 in the normal part: (1+e) P."},
       {6 * n - 1.5 * t, "1 + e is missing: (1+e) P + κ (Q - P)."},
       {4.5 * n + 1.125 * t, "The sign of Q: Q = -K⁻¹ u is what stops the slip and the approach."}},
      "J = (1+e) P + κ (Q - P), P = 6 n N s, Q - P = -3 t N s, κ = 3/4.");
  expect_near_vector(
      what + "0.5 [N s]", "Eq. (7.7), (7.8)", safe_impulse(K_of_sphere(m), u, n, 0.5, 0.5), 9 * n - 3 * t,
      roundings(64, 10),
      {{9 * n - 4.5 * t, "κ is 1.5 here, more than it takes to stop the slip: the largest in [0, 1] is 1."},
       {9 * n, "This is κ = 0, without friction. Eq. (7.8) wants the largest κ in the cone: here 1."},
       {3 * n + 1.5 * t, "The sign of Q: Q = -K⁻¹ u is what stops the slip and the approach."}},
      "J = (1+e) P + κ (Q - P), κ = 1: the cone is wide enough to stop the slip.");
}

const std::string into_the_cone =
    "|D_t| - μ D·n, D = Q - P, is not positive: J goes deeper into the cone as κ grows and never leaves it, so "
    "that κ is 1. Divide only by what is positive.";

EXERCISE_TEST(SafeImpulse, OfARodByHand) {
  // K⁻¹ is (5/8, 3/8; 3/8, 5/8) kg in the x-z plane. P = 0.4 n, Q = (0.21875, 0, 0.53125) N s.
  const Impact rod{.K = K_of_rod(), .u = Vec3(0.25, 0, -1), .n = Vec3(0, 0, 1), .e = 1, .mu = 0.6};
  expect_near_vector(
      "J of a rod of 1 kg that hits the floor at 45°, u = (0.25, 0, -1) m/s, e = 1, μ = 0.6 [N s]",
      "Eq. (7.7), (7.8)", safe_impulse(rod.K, rod.u, rod.n, rod.e, rod.mu), Vec3(0.21875, 0, 0.93125),
      roundings(64),
      {{rod.safe(rod.kappa_by_division()), "κ is not limited to 1: more than Q - P speeds the slip up again."},
       {rod.safe(0), "This is κ = 0. Eq. (7.8) wants the largest κ in the cone: here 1."},
       {2 * (rod.P() + rod.D()), "This is (1+e) Q. Only P is increased by the restitution."},
       {rod.stick(), "This is the impulse that sticks, Eq. (7.3), which adds energy here."}},
      "J = (1+e) P + κ (Q - P), with κ = 1: |J_t| = 0.22 N s is inside μ J_n = 0.56 N s.");
  // |D_t| - μ D·n = 0.21875 - 2·0.13125 is negative.
  Impact rough = rod;
  rough.mu = 2;
  expect_near_vector("J of the same rod, μ = 2: D = Q - P points into the cone [N s]", "Eq. (7.8)",
                     safe_impulse(rough.K, rough.u, rough.n, rough.e, rough.mu), Vec3(0.21875, 0, 0.93125),
                     roundings(64),
                     {{rough.safe(rough.kappa_by_division()), into_the_cone},
                      {rough.safe(0), "This is κ = 0. " + into_the_cone}},
                     into_the_cone);
}

EXERCISE_TEST(SafeImpulse, HasTheRestitutionWhateverK) {
  Random random;
  for (int trial = 0; trial < 1000 && !::testing::Test::HasFailure(); ++trial) {
    const Impact impact = trial % 2 ? random_impact(random) : impact_of_any_K(random);
    given() = impact.text();
    const auto& [K, u, n, e, mu] = impact;
    const Vec3 J = safe_impulse(K, u, n, e, mu);
    const double w = impact.approach();
    expect_near("u'·n = (u + K J)·n [m/s]", "Eq. (7.2), (7.7)", n.dot(u + K * J), e * w,
                impact.velocity_roundings(64, J),
                {{0, "1 + e is missing: (1+e) P + κ (Q - P)."},
                 {-w, "Nothing has changed along n."},
                 {-w + (1 + e) * w * n.dot(K * n), "P must be divided by n·Kn: it is an impulse."}},
                "P and Q both stop the approach, n·K(Q - P) = 0: κ has no part in u'·n.");
  }
}

EXERCISE_TEST(SafeImpulse, IsTheLargestInsideTheCone) {
  Random random;
  int at_edge = 0, whole = 0;
  for (int trial = 0; trial < 1000 && !::testing::Test::HasFailure(); ++trial) {
    const Impact impact = trial % 2 ? random_impact(random) : impact_of_any_K(random);
    given() = impact.text();
    const auto& [K, u, n, e, mu] = impact;
    const Vec3 J = safe_impulse(K, u, n, e, mu);
    const double edge = impact.kappa_of_the_edge(), D_n = impact.D().dot(n);
    const double blind_edge = mu * (1 + e) * impact.P().dot(n) / (impact.D() - D_n * n).norm();
    const double leaves_by_D = impact.D().norm() - mu * D_n;
    const double edge_by_D = leaves_by_D > 0 ? mu * (1 + e) * impact.P().dot(n) / leaves_by_D : 1;
    ++(edge < 1 ? at_edge : whole);
    const double J_n = J.dot(n), slack = impact.safe_roundings(64).value * (1 + mu);
    const std::string text = edge < 1 ? ", where it leaves the cone" : ", still inside the cone";
    expect_at_most("|J_t| - μ J_n [N s]", "Eq. (7.4)", (J - J_n * n).norm() - mu * J_n, slack,
                   "64 roundings of solving with K",
                   "Outside the cone. κ changes J_t and J_n both: |J_t| = κ |D_t| and J_n = (1+e) p + κ D_n, "
                   "D = Q - P.");
    expect_near_vector(
        "J for κ = " + show(std::min(1.0, edge)) + text + " [N s]", "Eq. (7.7), (7.8)", J, impact.safe(),
        impact.safe_roundings(64),
        {{impact.safe(0), impact.leaves() > 0
                              ? "This is κ = 0, without friction. Eq. (7.8) wants the largest κ in the cone."
                              : "This is κ = 0. " + into_the_cone},
         {impact.safe(1), "This is κ = 1, whatever the cone."},
         {impact.safe(impact.kappa_by_division()),
          impact.leaves() > 0 ? "κ is not limited to 1: more than Q - P speeds the slip up again."
                              : "κ has become negative. " + into_the_cone},
         {impact.safe(std::min(1.0, blind_edge)),
          "κ has been found with J_n = (1+e) p alone. J_n changes with κ as well, by κ (Q - P)·n."},
         {impact.safe(std::min(1.0, edge_by_D)),
          "κ has been found with |D| for |D_t|, D = Q - P: only the tangential part brings J nearer to the "
          "edge."},
         {impact.stick(), "This is the impulse that sticks, Eq. (7.3)."},
         {(1 + e) * (impact.P() + std::min(1.0, edge) * impact.D()),
          "Only P is increased by the restitution: (1+e) P + κ (Q - P)."}},
        "J = (1+e) P + κ (Q - P), with the largest κ in [0, 1] for which J is inside the cone.");
  }
  if (::testing::Test::HasFailure()) return;
  given().clear();
  expect_true("some of 1000 impacts are held by the cone, and some not", "Eq. (7.8)",
              at_edge > 50 && whole > 50);
}

EXERCISE_TEST(SafeImpulse, LosesThePredictedEnergy) {
  Random random;
  for (int trial = 0; trial < 1000 && !::testing::Test::HasFailure(); ++trial) {
    const Impact impact = trial % 2 ? random_impact(random) : impact_of_any_K(random);
    given() = impact.text();
    const auto& [K, u, n, e, mu] = impact;
    const Vec3 J = safe_impulse(K, u, n, e, mu);
    const Vec3 P = impact.P(), D = impact.D();
    const double kappa = std::min(1.0, impact.kappa_of_the_edge()), DKD = D.dot(K * D);
    const double from_P = -(1 - e * e) * P.dot(K * P) / 2;
    expect_near(
        "ΔE of the safe impulse [J]", "Eq. (7.6), (7.14)", impact.work(J),
        from_P - kappa * (1 - kappa / 2) * DKD, impact.energy_roundings(64 * impact.edge_loss(), J),
        {{from_P, "Only the approach has lost energy: κ is 0."}},
        "-½(1 - e²) P·KP - κ(1 - κ/2) D·KD, D = Q - P: both parts of J are there, and κ as in Eq. (7.8).");
  }
}

EXERCISE_TEST(SafeImpulse, NeverAddsEnergy) {
  Random random;
  for (int trial = 0; trial < 100000 && !::testing::Test::HasFailure(); ++trial) {
    const Impact impact = trial % 2 ? random_impact(random) : impact_of_any_K(random);
    const Vec3 J = safe_impulse(impact.K, impact.u, impact.n, impact.e, impact.mu);
    if (impact.work(J) <= 0) continue;
    given() = impact.text();
    expect_at_most("ΔE of the safe impulse [J]", "Eq. (7.6), (7.14)", impact.work(J),
                   impact.energy_roundings(64, J).value, "64 roundings of the energies in it",
                   "It adds energy. Every term of Eq. (7.14) is negative for 0 <= κ <= 2 and e <= 1.");
  }
}

EXERCISE_TEST(SafeImpulse, WithoutFrictionIsAlongTheNormal) {
  const Vec3 n(0, 0, 1);
  const std::string rule = "With μ = 0 only n itself is in the cone: J = (1+e) P = 1.2 N s along n.";
  expect_near_vector("J of a rod that slips, μ = 0, e = 0.5 [N s]", "Eq. (7.8)",
                     safe_impulse(K_of_rod(), Vec3(0.5, 0, -2), n, 0.5, 0), Vec3(0, 0, 1.2), roundings(16), {},
                     rule);
  // Here Q - P = 0: every κ will do, and the edge of the cone is at 0/0.
  expect_near_vector("J of a sphere of 1 kg that comes straight down at 0.8 m/s, μ = 0, e = 0.5 [N s]",
                     "Eq. (7.8)", safe_impulse(K_of_sphere(1), Vec3(0, 0, -0.8), n, 0.5, 0), Vec3(0, 0, 1.2),
                     roundings(16), {}, rule + " Where nothing leaves the cone there is nothing to divide by.");
}

EXERCISE_TEST(SafeImpulse, StopsTheContactInAWideCone) {
  Random random;
  for (int trial = 0; trial < 200 && !::testing::Test::HasFailure(); ++trial) {
    const Impact impact = random_impact(random);
    given() = impact.text();
    const Vec3 J = safe_impulse(impact.K, impact.u, impact.n, 0, 1e6);
    if (impact.solve(-impact.u).dot(impact.n) < 1e-3) continue;  // then even so wide a cone doesn't contain Q
    expect_near_vector("u' = u + K J for e = 0 and a huge μ [m/s]", "Eq. (7.7)", Vec3(impact.u + impact.K * J),
                       Vec3::Zero(), impact.velocity_roundings(64, J), {},
                       "Then κ = 1 and J = P + (Q - P) = Q = -K⁻¹ u, which stops slip and approach.");
  }
}

EXERCISE_TEST(SafeImpulse, DropsNothingSmall) {
  const Mat3 K = Mat3::Identity();
  for (const double part : relative_scales) {
    for (const Vec3& leaning : lopsided(part)) {
      const Vec3 n = leaning.normalized();
      expect_each_near<Vec3>("J of 1 kg that comes straight at 2 m/s, e = 0.5 [N s]", "Eq. (7.7)",
                             safe_impulse(K, -2 * n, n, 0.5, 0), 3 * n, 16);
    }
    for (int c = 0; c < 3; ++c) {
      const Vec3 n = Vec3::Unit(c), ahead = Vec3::Unit((c + 1) % 3), aside = part * Vec3::Unit((c + 2) % 3);
      const Vec3 slip = ahead + aside;
      expect_each_near<Vec3>("J of 1 kg that comes at 1 m/s, slips, and is stopped, e = 0.5, μ = 1 [N s]",
                             "Eq. (7.7)", safe_impulse(K, slip - n, n, 0.5, 1), 1.5 * n - slip, 16);
      expect_each_near<Vec3>("J of 1 kg that comes at " + show(part) + " of its slip, e = 0.5, μ = 1/2 [N s]",
                             "Eq. (7.7), (7.8)", safe_impulse(K, ahead - part * n, n, 0.5, 0.5),
                             1.5 * part * (n - 0.5 * ahead), 16);
      expect_each_near<Vec3>("J of 1 kg that slips at " + show(part) + " of its approach, e = 0.5, μ = 1 [N s]",
                             "Eq. (7.7)", safe_impulse(K, part * ahead - n, n, 0.5, 1), 1.5 * n - part * ahead,
                             16);
      expect_each_near<Vec3>(
          "J of 1 kg that comes at " + show(part) + " of its slip, and is stopped, e = 0.5 [N s]", "Eq. (7.7)",
          safe_impulse(K, ahead - part * n, n, 0.5, 2 / part), 1.5 * part * n - ahead, 16);
    }
    for (const double slip : {-2.0, 2.0})
      for (const double mu : {part, 1 / part}) {
        const Impact rod{K_of_rod(), Vec3(slip, 0, -1), Vec3::UnitZ(), 0.5, mu};
        expect_each_near<Vec3>(
            "J of a rod that slips at " + show(slip) + " m/s, e = 0.5, μ = " + show(mu) + " [N s]",
            "Eq. (7.7), (7.8)", safe_impulse(rod.K, rod.u, rod.n, rod.e, rod.mu), rod.safe(), 256);
      }
    // It leaves the cone by the tip: |D_t| is small beside μ D_n, and κ less than 1.
    const Impact steep{K_of_rod(), Vec3(20, 0, -1), Vec3::UnitZ(), 0.5, 1 / part};
    expect_near_vector("J of a rod that slips at 20 m/s, e = 0.5, μ = " + show(1 / part) + " [N s]",
                       "Eq. (7.7), (7.8)", safe_impulse(steep.K, steep.u, steep.n, steep.e, steep.mu),
                       steep.safe(), roundings(256), {}, small_is_dropped);
    if (::testing::Test::HasFailure()) return;
  }
}

EXERCISE_TEST(ImpactWork, DropsNothingSmall) {
  for (const double part : relative_scales) {  // J·u = -2 (1 + p), and ½ J·KJ is larger by the part p
    const double work = impact_work(Mat3::Identity(), Vec3(0, 0, -1), Vec3(0, 0, 2 * (1 + part)));
    expect_near("ΔE, which is " + show(part) + " of either of its terms [J]", "Eq. (7.6)", work,
                2 * (1 + part) * part, roundings(16), {{0, "There is none. " + small_is_dropped}},
                small_is_dropped);
    if (::testing::Test::HasFailure()) return;
  }
}

}  // namespace
