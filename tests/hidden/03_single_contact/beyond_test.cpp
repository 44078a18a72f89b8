// Beyond chapter 03's own tests: exchanged bodies, and what an impulse does.
#include "03_single_contact/single_contact.hpp"
#include "dense_rows.hpp"
#include "exercise_test.hpp"

using namespace spook;
using namespace spook::testing;

namespace {

EXERCISE(SpookParameters, "3.1 spook_parameters");
EXERCISE(ContactJacobian, "3.2 contact_jacobian");
EXERCISE(CollisionMatrix, "3.3 collision_matrix");
EXERCISE(ContactImpulse, "3.4 contact_impulse");

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

}  // namespace
