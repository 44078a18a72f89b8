// Beyond chapter 05's own tests: frames near every axis, any masses and sizes, what makes no sense.
#include "05_friction_box/friction_box.hpp"
#include "dense_rows.hpp"
#include "exercise_test.hpp"
#include "stages.hpp"

using namespace spook;
using namespace spook::testing;

namespace {

EXERCISE(Tangents, "5.1 tangents");
EXERCISE(FrictionParameters, "5.2 friction_parameters");
EXERCISE(RepresentativeMass, "5.3 representative_mass");
EXERCISE(FrictionBound, "5.4 friction_bound");
EXERCISE(FrictionConstraints, "5.5 friction_constraints");
EXERCISE(FrictionImpulse, "5.6 friction_impulse");
EXERCISE(StepFriction, "5.7 step_friction");

EXERCISE_TEST(Tangents, AreAFrameNearEveryAxis) {
  Random random;
  for (int axis = 0; axis < 3; ++axis)
    for (const double sign : {1.0, -1.0})
      for (const double off : {0.0, 1e-300, 1e-16, 1e-8, 1e-3}) {
        const Vec3 aside = random.vector();
        const Vec3 n = (sign * Vec3::Unit(axis) + off * aside).normalized();
        const spook::Tangents t = tangents(n);
        expect_near_vector("t1 × t2", "Eq. (5.1)", Vec3(t.t1.cross(t.t2)), n, roundings(32));
        expect_near("t1 · t2", "Eq. (5.1)", t.t1.dot(t.t2), 0, roundings(32));
        expect_near("|t1|", "Eq. (5.1)", t.t1.norm(), 1, roundings(32));
      }
}

EXERCISE_TEST(FrictionParameters, AreADamper) {
  Random random;
  const double h = random.log_uniform(1e-3, 0.1), c = random.log_uniform(1, 1e12);
  const SpookParameters found = friction_parameters(h, c);
  expect_near("a", "Eq. (5.3)", found.a, 0, {0, "exact"});
  expect_near("b", "Eq. (5.3)", found.b, 1, {0, "exact"});
  expect_near("Γ h c", "Eq. (5.4)", found.Sigma * h * c, 1, roundings(8));
}

EXERCISE_TEST(RepresentativeMass, DoesNotAskWhichBodyIsFirst) {
  Random random;
  const double i = random.log_uniform(0.01, 100), j = random.log_uniform(0.01, 100);
  const int contacts = random.integer(1, 9);
  const double mass = representative_mass(i, j, contacts);
  expect_near("with the bodies exchanged [kg]", "Eq. (5.6)", representative_mass(j, i, contacts), mass,
              roundings(16, mass));
  expect_near("times the contacts and the sum of both 1/m", "Eq. (5.6)", mass * contacts * (i + j), 1,
              roundings(16));
}

EXERCISE_TEST(FrictionBound, IsAProduct) {
  Random random;
  const double mu = random.uniform(0, 2), m = random.log_uniform(0.1, 100), g = random.uniform(0, 10);
  const double h = random.log_uniform(1e-3, 0.1);
  expect_near("Λ [N s]", "Eq. (5.7)", friction_bound(mu, m, g, h), mu * m * g * h,
              roundings(16, mu * m * g * h));
}

EXERCISE_TEST(FrictionImpulse, StopsWhatItCanAndNoMore) {
  Random random;
  const spook::Tangents t = tangents(random.unit_vector());
  const double m = random.uniform(0.5, 4);
  const double s1 = random.uniform(-3, 3), s2 = random.uniform(-3, 3);
  const Mat3 K = Mat3::Identity() / m;
  const Vec3 u = s1 * t.t1 + s2 * t.t2;
  expect_near_vector("impulse that stops the slip [N s]", "Eq. (5.3)", friction_impulse(K, u, t, 0, 100 * m),
                     Vec3(-m * u), roundings(64, m * u.norm()));
  const double bound = 0.25 * m * std::min(std::abs(s1), std::abs(s2));
  const Vec3 J = friction_impulse(K, u, t, 0, bound);
  expect_near("its part along t1 [N s]", "Eq. (5.8)", J.dot(t.t1), std::copysign(bound, -s1),
              roundings(64, m * u.norm()));
  expect_near("its part along t2 [N s]", "Eq. (5.8)", J.dot(t.t2), std::copysign(bound, -s2),
              roundings(64, m * u.norm()));
}

EXERCISE_TEST(FrictionParameters, AreRefusedWhereTheyMakeNoSense) {
  for (const double bad : {0.0, -1.0, std::nan("")}) {
    expect_rejects("h = " + std::to_string(bad), "h", [&] { friction_parameters(bad, 1); });
    expect_rejects("c = " + std::to_string(bad), "c", [&] { friction_parameters(1, bad); });
  }
  expect_near("Γ of an infinite c", "Eq. (5.4)", friction_parameters(0.1, infinity).Sigma, 0, {0, "exact"});
}

EXERCISE_TEST(RepresentativeMass, IsRefusedWhereNothingMoves) {
  expect_near("beside a static body [kg]", "Eq. (5.6)", representative_mass(0, 0.5, 2), 1, roundings(4));
  expect_rejects("two static bodies", "inverse_mass_j", [] { representative_mass(0, 0, 1); });
  expect_rejects("no contacts", "contacts", [] { representative_mass(1, 1, 0); });
  expect_rejects("a negative mass", "inverse_mass_i", [] { representative_mass(-1, 3, 1); });
}

EXERCISE_TEST(FrictionBound, IsRefusedWhereItMakesNoSense) {
  expect_near("Λ where nothing presses [N s]", "Eq. (5.7)", friction_bound(0.5, 2, 0, 0.1), 0, {0, "exact"});
  for (const double bad : {-1.0, std::nan("")}) {
    expect_rejects("mu = " + std::to_string(bad), "mu", [&] { friction_bound(bad, 1, 1, 1); });
    expect_rejects("mass = " + std::to_string(bad), "mass", [&] { friction_bound(1, bad, 1, 1); });
    expect_rejects("g = " + std::to_string(bad), "normal_gravity", [&] { friction_bound(1, 1, bad, 1); });
    expect_rejects("h = " + std::to_string(bad), "h", [&] { friction_bound(1, 1, 1, bad); });
  }
}

EXERCISE_TEST(FrictionConstraints, AreTheRatesAlongBothTangents) {
  Random random;
  for (int k = 0; k < 20; ++k) {
    const Contact contact{.i = k % 2 ? 3 : 8,
                          .j = 5,
                          .n = random.unit_vector(),
                          .gap = random.uniform(-0.1, 0.1),
                          .r_i = random.vector(3),
                          .r_j = random.vector(3)};
    const double angle = random.uniform(0, 6), bound = random.log_uniform(1e-9, 10);
    const spook::Tangents frame = tangents(contact.n);
    const spook::Tangents t{std::cos(angle) * frame.t1 + std::sin(angle) * frame.t2,
                            std::cos(angle) * frame.t2 - std::sin(angle) * frame.t1};
    const SpookParameters spook{.a = 0, .b = 1, .Sigma = random.log_uniform(1e-9, 1)};
    const auto rigid = friction_constraints<6>(contact, t, bound, spook);
    const auto points = friction_constraints<3>(contact, t, bound, spook);
    const Twist<6> Wi = random.twist(), Wj = random.twist();
    const Vec3 u = Wj.head<3>() + Vec3(Wj.tail<3>()).cross(contact.r_j) - Wi.head<3>() -
                   Vec3(Wi.tail<3>()).cross(contact.r_i);
    for (std::size_t c = 0; c < 2; ++c) {
      const Vec3 along = c == 0 ? t.t1 : t.t2;
      expect_near("G W along a tangent [m/s]", "Eq. (5.2)", rigid[c].Gi.dot(Wi) + rigid[c].Gj.dot(Wj),
                  u.dot(along), roundings(64, 10));
      expect_near_vector("Gj of a point mass", "Eq. (5.2)", Vec3(points[c].Gj), along, roundings(4));
      expect_near_vector("Gi of a point mass", "Eq. (5.2)", Vec3(points[c].Gi), Vec3(-along), roundings(4));
      expect_true("bodies, bounds, a gap of 0 and the parameters are those given", "Eq. (5.8)",
                  rigid[c].i == contact.i && rigid[c].j == contact.j && rigid[c].lo == -bound &&
                      rigid[c].hi == bound && rigid[c].gap == 0 && rigid[c].spook.a == spook.a &&
                      rigid[c].spook.b == spook.b && rigid[c].spook.Sigma == spook.Sigma);
    }
  }
}

EXERCISE_TEST(FrictionImpulse, IsEachTangentsOwn) {
  Random random;
  for (int k = 0; k < 30; ++k) {
    const InverseMass<6> i = random_body(random), j = random_body(random);
    const Vec3 r_i = random.vector(), r_j = random.vector(), u = random.vector(k % 3 ? 1 : 1e-9);
    const Mat3 K = collision_matrix(i, r_i, j, r_j);
    const spook::Tangents t = tangents(random.unit_vector());
    const double Gamma = k % 4 == 0 ? 0 : random.log_uniform(1e-3, 1), bound = random.uniform(0, 0.3);
    Vec3 expected = Vec3::Zero();
    for (const Vec3& along : {t.t1, t.t2}) {
      const double wanted = -u.dot(along) / (along.dot(K * along) + Gamma);
      expected += std::max(-bound, std::min(bound, wanted)) * along;
    }
    expect_near_vector("J_t [N s]", "Eq. (5.3), (5.8)", friction_impulse(K, u, t, Gamma, bound), expected,
                       roundings(200, u.norm() * 10));
  }
}

EXERCISE_TEST(StepFriction, IsAStepOfAllRows) {
  Random random;
  auto drawn = crowd(random, 20, 60);
  auto& all = drawn.all;
  auto& contacts = drawn.contacts;
  open_every_third(contacts);
  all.mu = random.uniform(0.2, 0.8);
  all.viscosity = random.log_uniform(100, 1e4);
  const double h = random.uniform(0.05, 0.1);
  Simulation got = all;
  step_friction(got, contacts, h);
  expect_same_bodies("after a step with many rough contacts", "Eq. (5.3)-(5.8)", got,
                     assembled(all, contacts, h),
                     {1e-10, "roundings of 5 sweeps over some 270 rows, of impulses up to 100"});
  all.mu = -1;
  expect_rejects(
      "mu = -1", "mu", [&, some = contacts] { step_friction(all, some, h); }, "",
      [&] { return state_of(all); });
}

}  // namespace
