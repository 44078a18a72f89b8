// The arguments and results of this chapter's functions have these units, and the results are right in any units.
#include "bodies.hpp"
#include "contract.hpp"
#include "exercise_test.hpp"
#include "quantities.hpp"

using namespace spook;
using namespace spook::testing;

namespace {

EXERCISE(SpookParameters, "3.1 spook_parameters");
EXERCISE(ContactJacobian, "3.2 contact_jacobian");
EXERCISE(CollisionMatrix, "3.3 collision_matrix");
EXERCISE(ContactImpulse, "3.4 contact_impulse");

EXERCISE_TEST(SpookParameters, IsTheSameInAnyUnits) {
  using namespace units;
  for (const double d : {0.0, 3.0})
    expect_same_in_any_units("Eq. (3.4)-(3.6)", spook_parameters, by_field, 0.02 * s, 5000 * (N / m), d);
}

EXERCISE_TEST(ContactJacobian, IsTheSameInAnyUnits) {
  Random random;
  expect_same_in_any_units("Eq. (3.3)", contact_jacobian, units::by_field, RandomPair(random).contact);
}

EXERCISE_TEST(CollisionMatrix, IsTheSameInAnyUnits) {
  using namespace units;
  Random random;
  const RandomPair pair(random);
  expect_same_in_any_units("Eq. (3.8)", collision_matrix, 1 / kg, pair.i.inverse_mass, pair.contact.r_i * m,
                           pair.j.inverse_mass, pair.contact.r_j * m);
}

EXERCISE_TEST(ContactImpulse, IsTheSameInAnyUnits) {
  using namespace units;
  const SpookParameters spook{.a = 10, .b = 0.9, .Sigma = 0.1};
  for (const double gap : {-0.03, 0.0, 0.02, 0.2})  // pushes, the first three
    expect_same_in_any_units("Eq. (3.10), (3.11)", contact_impulse, N * s, spook, 1.5 * (1 / kg), gap * m,
                             -0.4 * (m / s), -0.1 * (m / s));
}

}  // namespace
