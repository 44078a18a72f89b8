// Beyond chapter 07's own tests: velocities after an impact, turned scenes, energy, momentum, many contacts.
#include "07_impacts/impacts.hpp"
#include "dense_rows.hpp"
#include "exercise_test.hpp"
#include "stages.hpp"

using namespace spook;
using namespace spook::testing;

namespace {

EXERCISE(StickImpulse, "7.1 stick_impulse");
EXERCISE(InsideCone, "7.2 inside_cone");
EXERCISE(SlidingImpulse, "7.3 sliding_impulse");
EXERCISE(ImpactWork, "7.4 impact_work");
EXERCISE(SafeImpulse, "7.5 safe_impulse");
EXERCISE(ImpactImpulse, "7.6 impact_impulse");
EXERCISE(ApplyImpact, "7.7 apply_impact");
EXERCISE(ResolveImpacts, "7.8 resolve_impacts");
EXERCISE(StepImpacts, "7.9 step_impacts");

struct Meeting {
  Vec3 n, u;
  double e, mu;
  Mat3 K;

  explicit Meeting(Random& random) {
    n = random.unit_vector();
    const Vec3 along = random.vector(3);
    u = along - along.dot(n) * n - random.uniform(0.5, 3) * n;
    e = random.uniform(0, 1);
    mu = random.uniform(0.05, 1);
    const InverseMass<6> i = random_body(random), j = random_body(random);
    const Vec3 r_i = random.vector(), r_j = random.vector();
    K = collision_matrix(i, r_i, j, r_j);
  }
};

EXERCISE_TEST(StickImpulse, LeavesTheVelocityThatIsAskedFor) {
  Random random;
  const Meeting m(random);
  const Vec3 after = m.u + m.K * stick_impulse(m.K, m.u, m.n, m.e);
  const double condition = m.K.norm() * m.K.inverse().norm();
  expect_near_vector("u after it [m/s]", "Eq. (7.2), (7.3)", after, Vec3(-m.e * m.u.dot(m.n) * m.n),
                     roundings(64 * condition, 5));
}

EXERCISE_TEST(InsideCone, DoesNotAskHowLargeAnImpulseIs) {
  Random random;
  const Vec3 n = random.unit_vector();
  Vec3 t = random.vector();
  t = (t - t.dot(n) * n).normalized();
  const double mu = random.uniform(0.1, 1);
  for (const double size : {1e-12, 1.0, 1e12}) {
    expect_true("just inside", "Eq. (7.4)", inside_cone(size * (n + 0.999 * mu * t), n, mu));
    expect_true("just outside", "Eq. (7.4)", !inside_cone(size * (n + 1.001 * mu * t), n, mu));
    expect_true("a pull", "Eq. (7.4)", !inside_cone(-size * n, n, mu));
  }
}

EXERCISE_TEST(SlidingImpulse, LiesOnTheConeAndBounces) {
  Random random;
  for (int k = 0; k < 20; ++k) {
    const Meeting m(random);
    const auto J = sliding_impulse(m.K, m.u, m.n, m.e, m.mu);
    if (!J) continue;
    const double normal = J->dot(m.n), condition = m.K.norm() * normal;
    expect_near("|J_t| over J_n", "Eq. (7.5)", (*J - normal * m.n).norm() / normal, m.mu, roundings(64));
    expect_near("u·n after it [m/s]", "Eq. (7.5)", (m.u + m.K * *J).dot(m.n), -m.e * m.u.dot(m.n),
                roundings(200, 5 + condition));
  }
}

EXERCISE_TEST(ImpactWork, IsTheEnergyOfAMass) {
  Random random;
  const double m = random.uniform(0.5, 4);
  const Vec3 u = random.vector(3), J = random.vector(3);
  const Vec3 after = u + J / m;
  const double change = 0.5 * m * (after.squaredNorm() - u.squaredNorm());
  expect_near("what the impulse adds [J]", "Eq. (7.6)", impact_work(Mat3::Identity() / m, u, J), change,
              roundings(64, m * (u.squaredNorm() + after.squaredNorm())));
}

EXERCISE_TEST(SafeImpulse, DoesNoPositiveWork) {
  Random random;
  for (int k = 0; k < 50; ++k) {
    const Meeting m(random);
    const Vec3 J = safe_impulse(m.K, m.u, m.n, m.e, m.mu);
    const double size = J.norm() * (m.u.norm() + m.K.norm() * J.norm());
    expect_at_most("work [J]", "Eq. (7.14)", J.dot(m.u + 0.5 * m.K * J), 1e-13 * size, "round-off");
  }
}

EXERCISE_TEST(ImpactImpulse, TurnsWithTheScene) {
  Random random;
  for (int k = 0; k < 20; ++k) {
    const Meeting m(random);
    const Mat3 R = random.rotation().toRotationMatrix();
    const Vec3 J = impact_impulse(m.K, m.u, m.n, m.e, m.mu);
    const Vec3 turned = impact_impulse(R * m.K * R.transpose(), R * m.u, R * m.n, m.e, m.mu);
    const double condition = m.K.norm() * m.K.inverse().norm();
    expect_near_vector("J in a turned scene [N s]", "Eq. (7.3), (7.5), (7.7)", turned, Vec3(R * J),
                       roundings(1e4 * condition, 1 + J.norm()));
  }
}

EXERCISE_TEST(ApplyImpact, ConservesMomentumAboutEveryPoint) {
  Random random;
  Motion<6> motion;
  for (int k = 0; k < 2; ++k) {
    motion.inverse_mass.push_back(random_body(random));
    motion.W.push_back(random.twist());
    motion.Wf.push_back(Twist<6>::Zero());
  }
  const Vec3 r_i = random.vector(), r_j = random.vector(), J = random.vector(3);
  const std::vector<Twist<6>> before = motion.W;
  apply_impact({.i = 0, .j = 1, .n = Vec3::UnitZ(), .gap = 0, .r_i = r_i, .r_j = r_j}, J, motion);
  Vec3 linear = Vec3::Zero(), angular = Vec3::Zero();  // about the contact point, where both bodies' arms end
  for (std::size_t k = 0; k < 2; ++k) {
    const Twist<6> change = motion.W[k] - before[k];
    const Vec3 p = change.head<3>() / motion.inverse_mass[k].linear;
    linear += p;
    angular += motion.inverse_mass[k].angular.inverse() * change.tail<3>() - (k ? r_j : r_i).cross(p);
  }
  expect_near_vector("momentum [N s]", "Eq. (7.9)", linear, Vec3(0, 0, 0), roundings(200, 10));
  expect_near_vector("angular momentum [N m s]", "Eq. (7.9)", angular, Vec3(0, 0, 0), roundings(2000, 20));
}

EXERCISE_TEST(InsideCone, IsRightAtItsTip) {
  const Vec3 n = Vec3::UnitZ();
  expect_true("no impulse is inside", "Eq. (7.4)", inside_cone(Vec3(0, 0, 0), n, 0.5));
  expect_true("a push without friction is inside", "Eq. (7.4)", inside_cone(Vec3(0, 0, 1), n, 0));
  expect_true("a pull without friction is not", "Eq. (7.4)", !inside_cone(Vec3(0, 0, -1), n, 0));
  expect_true("what rubs without a push is not", "Eq. (7.4)", !inside_cone(Vec3(1e-9, 0, 0), n, 2));
  expect_true("a NaN is not", "Eq. (7.4)", !inside_cone(Vec3(0, 0, std::nan("")), n, 0.5));
}

EXERCISE_TEST(SlidingImpulse, IsAlongTheSlip) {
  Random random;
  for (int k = 0; k < 30; ++k) {
    Meeting m(random);
    if (k % 5 == 0) m.u = m.u.dot(m.n) * m.n;  // without a slip
    if (k % 5 == 1) m.mu = 0;
    const Vec3 slip = m.u - m.u.dot(m.n) * m.n;
    const Vec3 t = k % 5 == 0 ? Vec3(0, 0, 0) : Vec3(slip.normalized());
    const double eased = m.n.dot(m.K * (m.n - m.mu * t));
    const auto J = sliding_impulse(m.K, m.u, m.n, m.e, m.mu);
    if (std::abs(eased) < 1e-3 * m.K.norm()) continue;
    expect_true("there is an impulse where it takes approach away", "Eq. (7.5)", J.has_value() == (eased > 0));
    if (!J || !(eased > 0)) continue;
    const Vec3 expected = -(1 + m.e) * m.u.dot(m.n) / eased * (m.n - m.mu * t);
    expect_near_vector("J [N s]", "Eq. (7.5)", *J, expected, roundings(1e4, 1 + expected.norm()));
  }
}

/// The impulse of (7.7) by halving: the most of Q - P that stays inside the cone.
Vec3 safe_by_halving(const Meeting& m) {
  const Vec3 P = -m.u.dot(m.n) / m.n.dot(m.K * m.n) * m.n, Q = m.K.inverse() * -m.u;
  const auto at = [&](double kappa) -> Vec3 { return (1 + m.e) * P + kappa * (Q - P); };
  const auto leaves = [&](double kappa) {
    const Vec3 J = at(kappa);
    return (J - J.dot(m.n) * m.n).norm() > m.mu * J.dot(m.n);
  };
  if (!leaves(1)) return at(1);
  double low = 0, high = 1;
  for (int k = 0; k < 60; ++k) (leaves((low + high) / 2) ? high : low) = (low + high) / 2;
  return at(low);
}

EXERCISE_TEST(SafeImpulse, IsTheMostThatTheConeAllows) {
  Random random;
  for (int k = 0; k < 60; ++k) {
    Meeting m(random);
    if (k % 6 == 0) m.mu = 0;
    if (k % 6 == 1) m.e = 0;
    if (k % 6 == 2) m.mu = 50;
    const Vec3 expected = safe_by_halving(m);
    const double condition = m.K.norm() * m.K.inverse().norm();
    expect_near_vector("J [N s]", "Eq. (7.7), (7.8)", safe_impulse(m.K, m.u, m.n, m.e, m.mu), expected,
                       roundings(1e4 * condition, 1 + expected.norm()));
  }
}

EXERCISE_TEST(ImpactImpulse, ChoosesItsCase) {
  Random random;
  for (int k = 0; k < 100; ++k) {
    Meeting m(random);
    if (k % 5 == 0) m.mu = random.uniform(1, 5);
    const Vec3 stick = stick_impulse(m.K, m.u, m.n, m.e);
    Vec3 expected = stick;
    if (!inside_cone(stick, m.n, m.mu)) {
      const auto slide = sliding_impulse(m.K, m.u, m.n, m.e, m.mu);
      expected = slide ? *slide : safe_impulse(m.K, m.u, m.n, m.e, m.mu);
    }
    if (impact_work(m.K, m.u, expected) > 0) expected = safe_impulse(m.K, m.u, m.n, m.e, m.mu);
    const double condition = m.K.norm() * m.K.inverse().norm();
    expect_near_vector("J [N s]", "Eq. (7.3), (7.5), (7.7)", impact_impulse(m.K, m.u, m.n, m.e, m.mu), expected,
                       roundings(100 * condition, 1 + expected.norm()));
    expect_near_vector("J of bodies that part [N s]", "Eq. (7.10)", impact_impulse(m.K, -m.u, m.n, m.e, m.mu),
                       Vec3(0, 0, 0), {0, "there is no impact"});
  }
}

/// The stage of impacts, contact by contact.
ImpactReport resolved(const std::vector<Contact>& contacts, const ImpactLaw& law, Motion<6>& motion) {
  ImpactReport report;
  for (int before = -1; !contacts.empty() && report.passes < law.max_passes && before != report.impacts;) {
    before = report.impacts;
    ++report.passes;
    for (const Contact& c : contacts) {
      const auto i = static_cast<std::size_t>(c.i), j = static_cast<std::size_t>(c.j);
      const Twist<6> Wi = motion.W[i] + motion.Wf[i] / 2, Wj = motion.W[j] + motion.Wf[j] / 2;
      const Vec3 u =
          Wj.head<3>() + Vec3(Wj.tail<3>()).cross(c.r_j) - Wi.head<3>() - Vec3(Wi.tail<3>()).cross(c.r_i);
      if (u.dot(c.n) >= -law.threshold) continue;
      const Mat3 K = collision_matrix(motion.inverse_mass[i], c.r_i, motion.inverse_mass[j], c.r_j);
      const Vec3 J = impact_impulse(K, u, c.n, law.restitution, law.friction);
      apply_impact(c, J, motion);
      report.energy += impact_work(K, u, J);
      ++report.impacts;
    }
  }
  return report;
}

EXERCISE_TEST(ResolveImpacts, GoesOverAllContactsUntilNoneMeets) {
  Random random;
  for (const int passes : {1, 2, 100}) {
    const auto [all, contacts] = crowd(random, 12, 20);
    const ImpactLaw law{
        .restitution = random.uniform(0.1, 0.9), .friction = 0.3, .threshold = 0.2, .max_passes = passes};
    Motion<6> got = motion_of(all, 0.1), expected = got;
    const ImpactReport report = resolve_impacts(contacts, law, got),
                       by_hand = resolved(contacts, law, expected);
    for (std::size_t b = 0; b < expected.W.size(); ++b)
      expect_near_vector("W of body " + std::to_string(b), "Eq. (7.1), (7.9), (7.10)", got.W[b], expected.W[b],
                         {1e-9, "roundings of a few hundred impacts"});
    expect_true("impacts and passes are counted", "Eq. (7.10)",
                report.impacts == by_hand.impacts && report.passes == by_hand.passes);
    expect_near("energy added [J]", "Eq. (7.6)", report.energy, by_hand.energy,
                {1e-9 * (1 + std::abs(by_hand.energy)), "roundings of a few hundred impacts"});
  }
}

EXERCISE_TEST(ResolveImpacts, RefusesALawThatMakesNoSense) {
  Random random;
  const auto [all, touching] = crowd(random, 5, 5);
  Motion<6> motion = motion_of(all, 0.1);
  const auto state = [&] { return std::vector<double>(motion.W[0].begin(), motion.W[0].end()); };
  const auto rejects = [&, contacts = touching](const std::string& name, const ImpactLaw& law) {
    expect_rejects(
        name, name, [&] { resolve_impacts(contacts, law, motion); }, "", state);
    expect_rejects(name + ", without contacts", name, [&] { resolve_impacts({}, law, motion); });
  };
  rejects("restitution", {.restitution = 1.1});
  rejects("restitution", {.restitution = std::nan("")});
  rejects("friction", {.friction = -1});
  rejects("threshold", {.threshold = -1});
  rejects("max_passes", {.max_passes = 0});
}

EXERCISE_TEST(StepImpacts, BouncesAndThenSteps) {
  Random random;
  const double h = 0.02;
  for (const double e : {0.0, 0.7}) {
    auto [all, contacts] = crowd(random, 12, 8);
    all.mu = 0.3;
    all.viscosity = 1e3;
    all.restitution = e;
    Simulation got = all, expected = all;
    if (e > 0) {
      Motion<6> motion = motion_of(all, h);
      resolved(contacts, {.restitution = e, .friction = all.mu, .threshold = all.gravity.norm() * h}, motion);
      for (std::size_t b = 0; b < motion.W.size(); ++b) {
        expected.bodies[b].v = motion.W[b].head<3>();
        expected.bodies[b].omega = motion.W[b].tail<3>();
      }
    }
    step_impacts(got, contacts, h);
    expect_same_bodies("after a step with impacts", "Eq. (7.1)-(7.10)", got, assembled(expected, contacts, h),
                       {1e-9, "roundings of a few hundred impacts and 5 sweeps"});
  }
}

}  // namespace
