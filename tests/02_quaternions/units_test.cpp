// Units of this chapter's arguments and results. The answers must be the same in any system of units.
#include "contract.hpp"
#include "top.hpp"

using namespace spook;
using namespace spook::testing;

namespace {

EXERCISE(QuaternionRate, "2.1 quaternion_rate");
EXERCISE(UpdateFirstOrder, "2.2 update_first_order");
EXERCISE(UpdateExponential, "2.3 update_exponential");
EXERCISE(WorldInertia, "2.4 world_inertia");
EXERCISE(GyroscopicTorque, "2.5 gyroscopic_torque");
EXERCISE(FreeRotation, "2.6 free_rotation");

EXERCISE_TEST(QuaternionRate, IsTheSameInAnyUnits) {
  using namespace units;
  Random random;
  const Top top = random_top(random);
  expect_same_in_any_units("Eq. (2.3)", quaternion_rate, 1 / s, top.q, top.omega * (1 / s));
}

EXERCISE_TEST(UpdateFirstOrder, IsTheSameInAnyUnits) {
  using namespace units;
  Random random;
  const Top top = random_top(random);
  expect_same_in_any_units("Eq. (2.4)", update_first_order, pure, top.q, top.omega * (1 / s), 0.1 * s);
}

EXERCISE_TEST(UpdateExponential, IsTheSameInAnyUnits) {
  using namespace units;
  Random random;
  const Top top = random_top(random);
  expect_same_in_any_units("Eq. (2.6)", update_exponential, pure, top.q, top.omega * (1 / s), 0.1 * s);
}

EXERCISE_TEST(WorldInertia, IsTheSameInAnyUnits) {
  using namespace units;
  Random random;
  const Top top = random_top(random);
  expect_same_in_any_units("Eq. (2.7)", world_inertia, kg * m * m, top.q, top.principal * (kg * m * m));
}

EXERCISE_TEST(GyroscopicTorque, IsTheSameInAnyUnits) {
  using namespace units;
  Random random;
  const Top top = random_top(random);
  const Mat3 inertia = world_inertia(top.q, top.principal);
  expect_same_in_any_units("Eq. (2.9)", gyroscopic_torque, N * m, inertia * (kg * m * m), top.omega * (1 / s));
}

EXERCISE_TEST(FreeRotation, IsTheSameInAnyUnits) {
  using namespace units;
  Random random;
  const Top top = random_top(random);
  expect_same_in_any_units("Eq. (2.11)", free_rotation, nothing, top.q, top.omega * (1 / s),
                           top.principal * (kg * m * m), 0.1 * s);
}

}  // namespace
