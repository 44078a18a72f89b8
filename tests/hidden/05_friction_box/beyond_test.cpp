// Beyond chapter 05's own tests: frames near every axis, and a box that is the same along both tangents.
#include "05_friction_box/friction_box.hpp"
#include "exercise_test.hpp"

using namespace spook;
using namespace spook::testing;

namespace {

EXERCISE(Tangents, "5.1 tangents");
EXERCISE(FrictionParameters, "5.2 friction_parameters");
EXERCISE(RepresentativeMass, "5.3 representative_mass");
EXERCISE(FrictionBound, "5.4 friction_bound");
EXERCISE(FrictionImpulse, "5.6 friction_impulse");

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

}  // namespace
