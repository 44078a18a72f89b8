// Beyond chapter 03's own tests: exchanged bodies, any size and sign, what an impulse does.
#include "03_single_contact/single_contact.hpp"
#include "dense_rows.hpp"
#include "exercise_test.hpp"
#include "stages.hpp"

using namespace spook;
using namespace spook::testing;

namespace {

EXERCISE(SpookParameters, "3.1 spook_parameters");
EXERCISE(ContactJacobian, "3.2 contact_jacobian");
EXERCISE(CollisionMatrix, "3.3 collision_matrix");
EXERCISE(ContactImpulse, "3.4 contact_impulse");
EXERCISE(StepTouching, "3.5 step_touching");

EXERCISE_TEST(SpookParameters, BelongTogether) {
  Random random;
  const double h = random.log_uniform(1e-3, 0.1), k = random.log_uniform(1e3, 1e8);
  const double d = random.uniform(0, 10);
  const spook::SpookParameters found = spook_parameters(h, k, d);
  expect_near("b + a h/4", "Eq. (3.4), (3.5)", found.b + found.a * h / 4, 1, roundings(16));
  expect_near("Σ h k/a", "Eq. (3.4), (3.6)", found.Sigma * h * k / found.a, 1, roundings(16));
}

EXERCISE_TEST(ContactJacobian, IsTheSameRowForExchangedBodies) {
  Random random;
  const Vec3 n = random.unit_vector(), r_i = random.vector(3), r_j = random.vector(3);
  const spook::ContactJacobian G =
      contact_jacobian({.i = 0, .j = 1, .n = n, .gap = 0.1, .r_i = r_i, .r_j = r_j});
  const spook::ContactJacobian other =
      contact_jacobian({.i = 1, .j = 0, .n = -n, .gap = 0.1, .r_i = r_j, .r_j = r_i});
  expect_near_vector("block of the first body", "Eq. (3.3)", other.Gj, G.Gi, roundings(16, 5));
  expect_near_vector("block of the second body", "Eq. (3.3)", other.Gi, G.Gj, roundings(16, 5));
}

EXERCISE_TEST(CollisionMatrix, SaysWhatAnImpulseDoes) {
  Random random;
  const InverseMass<6> i = random_body(random), j = random_body(random);
  const Vec3 r_i = random.vector(2), r_j = random.vector(2), J = random.vector(3);
  const Vec3 of_j = j.linear * J + (j.angular * r_j.cross(J)).cross(r_j);
  const Vec3 of_i = -i.linear * J - (i.angular * r_i.cross(J)).cross(r_i);
  expect_near_vector("K J, the change of the relative velocity [m/s]", "Eq. (3.8)",
                     Vec3(collision_matrix(i, r_i, j, r_j) * J), of_j - of_i, roundings(200, 200));
}

EXERCISE_TEST(ContactImpulse, HoldsEveryWeightAtItsDepth) {
  Random random;
  for (int k = 0; k < 20; ++k) {
    const double m = random.log_uniform(0.01, 1e4), h = random.log_uniform(1e-3, 0.1);
    const double stiffness = random.log_uniform(1e3, 1e7), d = random.uniform(0, 6), g = 9.81;
    const double got = contact_impulse(spook_parameters(h, stiffness, d), 1 / m, -m * g / stiffness, 0, -h * g);
    expect_near("λ of a body that rests m g/k deep [N s]", "Eq. (3.13)", got, h * m * g,
                roundings(64, h * m * g));
  }
}

EXERCISE_TEST(SpookParameters, AreThoseOfAnyStep) {
  Random random;
  for (const double d : {0.0, 1e-9, 0.25, 3.0, 1e9}) {
    const double h = random.log_uniform(1e-6, 1), k = random.log_uniform(1, 1e15);
    const spook::SpookParameters found = spook_parameters(h, k, d);
    const double a = 4 / (h * (1 + 4 * d));
    expect_near("a [1/s]", "Eq. (3.4)", found.a, a, roundings(16, a));
    expect_near("b", "Eq. (3.5)", found.b, 4 * d / (1 + 4 * d), roundings(16, 4 * d / (1 + 4 * d)));
    expect_near("Σ [1/kg]", "Eq. (3.6)", found.Sigma, a / (h * k), roundings(16, a / (h * k)));
  }
  for (const double bad : {-1.0, std::nan(""), infinity}) {
    expect_rejects("h = " + std::to_string(bad), "h", [&] { spook_parameters(bad, 1, 1); });
    expect_rejects("k = " + std::to_string(bad), "k", [&] { spook_parameters(1, bad, 0); });
    expect_rejects("d = " + std::to_string(bad), "d", [&] { spook_parameters(1, 1, bad); });
  }
}

EXERCISE_TEST(ContactJacobian, IsTheRateOfTheGap) {
  Random random;
  for (const double size : {1.0, 1e-9, 1e9})
    for (const double gap : {0.1, -0.1}) {
      const Vec3 n = random.unit_vector(), r_i = random.vector(size), r_j = random.vector(size);
      const spook::ContactJacobian G =
          contact_jacobian({.i = 7, .j = 2, .n = n, .gap = gap, .r_i = r_i, .r_j = r_j});
      const Vec3 v_i = random.vector(), v_j = random.vector();
      const Vec3 omega_i = random.vector(1 / size), omega_j = random.vector(1 / size);
      const double rate = (v_j + omega_j.cross(r_j) - v_i - omega_i.cross(r_i)).dot(n);
      expect_near("G W [m/s]", "Eq. (3.3)", G.Gi.dot(twist(v_i, omega_i)) + G.Gj.dot(twist(v_j, omega_j)), rate,
                  roundings(64, 8));
      expect_near_vector("force on body j per impulse", "Eq. (3.3)", Vec3(G.Gj.head<3>()), n, roundings(4));
    }
}

EXERCISE_TEST(ContactImpulse, PushesAndNeverPulls) {
  Random random;
  for (int k = 0; k < 50; ++k) {
    const spook::SpookParameters spook = {random.log_uniform(1, 100), random.uniform(0.1, 1),
                                          random.log_uniform(1e-3, 1)};
    const double nKn = k % 5 == 0 ? 0 : random.log_uniform(0.1, 10), gap = random.uniform(-0.1, 0.1);
    const double velocity = random.uniform(-1, 1), force = random.uniform(-1, 1) * (k % 3 == 0 ? 1e-9 : 1);
    const double wanted = (-spook.a * gap - spook.b * velocity - force) / (nKn + spook.Sigma);
    expect_near("λ [N s]", "Eq. (3.10), (3.11)", contact_impulse(spook, nKn, gap, velocity, force),
                wanted > 0 ? wanted : 0, roundings(16, 12 / (nKn + spook.Sigma)));
  }
  expect_true("a NaN stays one", "Eq. (3.11)",
              std::isnan(contact_impulse({.a = 1, .b = 1, .Sigma = 1}, 1, std::nan(""), 0, 0)));
}

EXERCISE_TEST(StepTouching, IsAStepOfOneRow) {
  Random random;
  for (int k = 0; k < 10; ++k) {
    auto drawn = crowd(random, 4, 1);
    auto& all = drawn.all;
    auto& contacts = drawn.contacts;
    contacts.resize(1);
    if (k % 3 == 0) contacts[0].gap = random.uniform(0, 0.02);
    const double h = random.uniform(0.05, 0.1);
    Simulation got = all;
    step_touching(got, contacts[0], h);
    expect_same_bodies("after a step with one contact", "Eq. (3.7), (4.5)", got, assembled(all, contacts, h),
                       {1e-10, "roundings of one row"});
    all.k = 0;
    expect_rejects(
        "k = 0", "k", [&] { step_touching(all, contacts[0], h); }, "", [&] { return state_of(all); });
  }
}

}  // namespace
