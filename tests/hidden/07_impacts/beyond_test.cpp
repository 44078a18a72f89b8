// Beyond chapter 07's own tests: velocities after an impact, turned scenes, energy, momentum.
#include "07_impacts/impacts.hpp"
#include "dense_rows.hpp"
#include "exercise_test.hpp"

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

EXERCISE_TEST(SafeImpulse, NeverAddsEnergy) {
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

}  // namespace
