// Units of this chapter's arguments and results. The answers must be the same in any system of units.
#include "contract.hpp"
#include "exercise_test.hpp"
#include "friction_systems.hpp"
#include "quantities.hpp"

using namespace spook;
using namespace spook::testing;

namespace {

EXERCISE(SlidingTangents, "9.1 sliding_tangents");
EXERCISE(LimitFriction, "9.2 limit_friction");
EXERCISE(TwoPassSolve, "9.3 two_pass_solve");
EXERCISE(OntoDisc, "9.4 onto_disc");
EXERCISE(UpdateFriction, "9.5 update_friction");
EXERCISE(SweepOnCones, "9.6 sweep_on_cones");
EXERCISE(ResidualOnCones, "9.7 residual_on_cones");
EXERCISE(ConeSolve, "9.8 cone_solve");

/// Contacts that stick, slide, and come apart, and joints between them; swept a little.
System<6> some_system(int sweeps) {
  Random random;
  System<6> system = random_system(random, 4, 4, 0.8);
  for (int k = 0; k < sweeps; ++k) sweep_on_cones(system.contacts, system.rows, system.V);
  return system;
}

const StopRule few_sweeps{.max_sweeps = 4, .tolerance = 0}, enough_sweeps{.max_sweeps = 500, .tolerance = 1e-5};

EXERCISE_TEST(SlidingTangents, IsTheSameInAnyUnits) {
  using namespace units;
  Random random;
  const Vec3 n = random.unit_vector(), u = random.vector();
  for (const double slow : {0.0, 1e-3, 10.0})
    expect_same_in_any_units_nans_aside("Eq. (9.2)", sliding_tangents, by_field, n, u * (m / s),
                                        slow * (m / s));
}

EXERCISE_TEST(LimitFriction, IsTheSameInAnyUnits) {
  const System<6> system = some_system(1);
  expect_same_in_any_units("Eq. (9.1)", limit_friction<6>, units::nothing, system.contacts, system.rows);
}

EXERCISE_TEST(TwoPassSolve, IsTheSameInAnyUnits) {
  using namespace units;
  const System<6> system = some_system(1);
  for (const StopRule& stop : {few_sweeps, enough_sweeps})
    expect_same_in_any_units("Eq. (9.1)", two_pass_solve<6>, by_field, system.contacts, system.rows,
                             system.V * velocity, stop);
}

EXERCISE_TEST(OntoDisc, IsTheSameInAnyUnits) {
  using namespace units;
  for (const double radius : {0.0, 0.3, 7.0})
    expect_same_in_any_units("Eq. (9.4)", onto_disc, N * s, Vec2(3, -4) * (N * s), radius * (N * s));
}

EXERCISE_TEST(UpdateFriction, IsTheSameInAnyUnits) {
  using namespace units;
  const System<6> system = some_system(1);
  for (const FrictionContact& contact : system.contacts)
    if (!expect_same_in_any_units("Eq. (9.5), (9.6)", update_friction<6>, m / s, contact, system.rows,
                                  system.V * velocity))
      return;
}

EXERCISE_TEST(SweepOnCones, IsTheSameInAnyUnits) {
  using namespace units;
  const System<6> system = some_system(1);
  expect_same_in_any_units("Eq. (9.6)", sweep_on_cones<6>, m / s, system.contacts, system.rows,
                           system.V * velocity);
}

EXERCISE_TEST(ResidualOnCones, IsTheSameInAnyUnits) {
  using namespace units;
  const System<6> system = some_system(1);
  expect_same_in_any_units("Eq. (9.7)", residual_on_cones<6>, m / s, system.contacts, system.rows,
                           system.V * velocity);
}

EXERCISE_TEST(ConeSolve, IsTheSameInAnyUnits) {
  using namespace units;
  const System<6> system = some_system(0);
  for (const StopRule& stop : {few_sweeps, enough_sweeps})
    expect_same_in_any_units("Eq. (4.9), (9.6)", cone_solve<6>, by_field, system.contacts, system.rows,
                             system.V * velocity, stop);
}

}  // namespace
