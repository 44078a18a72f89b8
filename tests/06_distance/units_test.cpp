// Units of this chapter's arguments and results. The answers must be the same in any system of units.
#include "attachments.hpp"
#include "contract.hpp"
#include "exercise_test.hpp"
#include "quantities.hpp"

using namespace spook;
using namespace spook::testing;

namespace spook::testing {

static void each_number(Visitor& visitor, Attachment& at, ByField) {
  visitor.count(at.body);
  each_number(visitor, at.x, units::m), each_number(visitor, at.r, units::m);
}

static void each_number(Visitor& visitor, Link& link, ByField) {
  visitor.count(link.i), visitor.count(link.j);
  visitor.number(link.length, units::m);
}

static void each_number(Visitor& visitor, Net& net, ByField) {
  each_number(visitor, net.x, units::m);
  each_number(visitor, net.mass, units::kg);
  each_number(visitor, net.links, units::by_field);
}

}  // namespace spook::testing

namespace {

EXERCISE(DistanceConstraint, "6.1 distance_constraint");
EXERCISE(BallJointConstraints, "6.2 ball_joint_constraints");
EXERCISE(Rope, "6.3 rope");
EXERCISE(Cloth, "6.4 cloth");

EXERCISE_TEST(DistanceConstraint, IsTheSameInAnyUnits) {
  using namespace units;
  const RandomPair pair;
  expect_same_in_any_units("Eq. (6.2)-(6.4)", distance_constraint<6>, by_field, pair.i, pair.j, pair.length * m,
                           pair.spook);
}

EXERCISE_TEST(BallJointConstraints, IsTheSameInAnyUnits) {
  const RandomPair pair;
  expect_same_in_any_units("Eq. (6.4)-(6.6)", ball_joint_constraints<6>, units::by_field, pair.i, pair.j,
                           pair.spook);
}

EXERCISE_TEST(Rope, IsTheSameInAnyUnits) {
  using namespace units;
  Random random;
  const Vec3 from = random.vector(), to = random.vector();
  expect_same_in_any_units("Eq. (6.10)", rope, by_field, from * m, to * m, 5, 3 * kg);
}

EXERCISE_TEST(Cloth, IsTheSameInAnyUnits) {
  using namespace units;
  Random random;
  const Vec3 corner = random.vector(), u(2, 0, 0.5), v(0.3, 1, 0);
  expect_same_in_any_units("Eq. (6.11)", cloth, by_field, corner * m, u * m, v * m, 3, 2, 4 * kg);
}

}  // namespace
