// Units of this chapter's arguments and results. The answers must be the same in any system of units.
#include "contract.hpp"
#include "exercise_test.hpp"
#include "quantities.hpp"
#include "sliding.hpp"

using namespace spook;
using namespace spook::testing;

namespace {

EXERCISE(Tangents, "5.1 tangents");
EXERCISE(FrictionParameters, "5.2 friction_parameters");
EXERCISE(RepresentativeMass, "5.3 representative_mass");
EXERCISE(FrictionBound, "5.4 friction_bound");
EXERCISE(FrictionConstraints, "5.5 friction_constraints");
EXERCISE(FrictionImpulse, "5.6 friction_impulse");

EXERCISE_TEST(Tangents, DependOnTheNormalAlone) {
  Random random;
  expect_same_in_any_units("Eq. (5.1)", tangents, units::by_field, random.unit_vector());
}

EXERCISE_TEST(FrictionParameters, IsTheSameInAnyUnits) {
  using namespace units;
  for (const double c : {200.0, infinity})
    expect_same_in_any_units("Eq. (5.4)", friction_parameters, by_field, 0.02 * s, c * (N * s / m));
}

EXERCISE_TEST(RepresentativeMass, IsTheSameInAnyUnits) {
  using namespace units;
  for (const double fixed : {0.0, 0.5})
    expect_same_in_any_units("Eq. (5.6)", representative_mass, kg, 3 * (1 / kg), fixed * (1 / kg), 4);
}

EXERCISE_TEST(FrictionBound, IsTheSameInAnyUnits) {
  using namespace units;
  expect_same_in_any_units("Eq. (5.7)", friction_bound, N * s, 0.4, 3 * kg, 9.81 * (m / (s * s)), 0.02 * s);
}

EXERCISE_TEST(FrictionConstraints, IsTheSameInAnyUnits) {
  using namespace units;
  Random random;
  const spook::Tangents t = random_tangents(random);
  Contact contact = contact_between(2, 5, t);
  contact.r_i = random.vector(), contact.r_j = random.vector();
  const SpookParameters spook{.a = 0, .b = 1, .Sigma = 0.1};
  expect_same_in_any_units("Eq. (5.2), (5.3), (5.8)", friction_constraints<6>, by_field, contact, t,
                           0.3 * (N * s), spook);
}

EXERCISE_TEST(FrictionImpulse, IsTheSameInAnyUnits) {
  using namespace units;
  Random random;
  const spook::Tangents t = random_tangents(random);
  const Mat3 K = Vec3(2, 3, 1).asDiagonal();
  const Vec3 u = random.vector();
  for (const double bound : {1e-3, 0.1, 10.0})  // slides, slides along one or both, sticks
    expect_same_in_any_units_nans_aside("Eq. (5.3), (5.8)", friction_impulse, N * s, K * (1 / kg), u * (m / s),
                                        t, 0.05 * (1 / kg), bound * (N * s));
}

}  // namespace
