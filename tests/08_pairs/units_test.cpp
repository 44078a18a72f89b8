// Units of this chapter's arguments and results. The answers must be the same in any system of units.
#include "contract.hpp"
#include "exercise_test.hpp"
#include "quantities.hpp"
#include "shapes.hpp"

using namespace spook;
using namespace spook::testing;

namespace spook::testing {

static void each_number(Visitor& visitor, Plane& plane, ByField) {
  visitor.count(plane.body);
  each_number(visitor, plane.x, units::m);
  each_number(visitor, plane.n, units::pure);
  visitor.number(plane.offset, units::m);
}

static void each_number(Visitor& visitor, Ball& ball, ByField) {
  visitor.count(ball.body);
  each_number(visitor, ball.x, units::m);
  visitor.number(ball.radius, units::m);
}

static void each_number(Visitor& visitor, Box& box, ByField) {
  visitor.count(box.body);
  each_number(visitor, box.x, units::m);
  each_number(visitor, box.axes, units::pure);
  each_number(visitor, box.half_sides, units::m);
}

static void each_number(Visitor& visitor, SeparatingAxis& axis, ByField) {
  each_number(visitor, axis.n, units::pure);
  visitor.number(axis.gap, units::m);
  for (const int index : {axis.face_i, axis.face_j, axis.edge_i, axis.edge_j}) visitor.count(index);
}

static void each_number(Visitor& visitor, spook::Bounds& bounds, ByField) {
  for (Vec3* corner : {&bounds.lower, &bounds.upper})
    for (double& x : *corner) visitor.bound(x, units::m);
}

}  // namespace spook::testing

namespace {

EXERCISE(PlaneBall, "8.1 plane_ball");
EXERCISE(BallBall, "8.2 ball_ball");
EXERCISE(PlaneBox, "8.3 plane_box");
EXERCISE(BoxBall, "8.4 box_ball");
EXERCISE(SeparatingAxis, "8.5 separating_axis");
EXERCISE(Clip, "8.6 clip");
EXERCISE(EdgeContact, "8.7 edge_contact");
EXERCISE(BoxBox, "8.8 box_box");
EXERCISE(Bounds, "8.9 bounds");
EXERCISE(SweepAndPrune, "8.10 sweep_and_prune");
EXERCISE(SpatialHash, "8.11 spatial_hash");

/// Number of random pairs of shapes for each function. Some of them touch and some do not.
constexpr int pairs_of_shapes = 30;

Plane some_plane(Random& random) {
  return {.body = 3, .x = random.vector(), .n = random.unit_vector(), .offset = random.uniform(-0.5, 0.5)};
}

Ball some_ball(Random& random, int body) {
  return {.body = body, .x = random.vector(0.6), .radius = random.uniform(0.2, 0.8)};
}

/// Boxes of any shape, near each other.
std::vector<spook::Bounds> some_bounds(Random& random) {
  std::vector<spook::Bounds> all;
  for (int k = 0; k < 60; ++k) {
    const Vec3 x = random.vector(3), half = random.vector(0, 1);
    all.push_back({.lower = x - half, .upper = x + half});
  }
  return all;
}

EXERCISE_TEST(PlaneBall, IsTheSameInAnyUnits) {
  Random random;
  for (int k = 0; k < pairs_of_shapes; ++k) {
    const Plane i = some_plane(random);
    const Ball j = some_ball(random, 1);
    if (!expect_same_in_any_units("Eq. (8.1)", plane_ball, units::by_field, i, j)) return;
  }
}

EXERCISE_TEST(BallBall, IsTheSameInAnyUnits) {
  Random random;
  for (int k = 0; k < pairs_of_shapes; ++k) {
    const Ball i = some_ball(random, 4);
    const Ball j = some_ball(random, 1);
    if (!expect_same_in_any_units("Eq. (8.2)", ball_ball, units::by_field, i, j)) return;
  }
}

EXERCISE_TEST(PlaneBox, IsTheSameInAnyUnits) {
  Random random;
  for (int k = 0; k < pairs_of_shapes; ++k) {
    const Plane i = some_plane(random);
    const Box j = random_box(random, 1);
    if (!expect_same_in_any_units("Eq. (8.4)", plane_box, units::nothing, i, j, std::vector<Contact>{})) return;
  }
}

EXERCISE_TEST(BoxBall, IsTheSameInAnyUnits) {
  Random random;
  for (int k = 0; k < pairs_of_shapes; ++k) {
    const Box i = random_box(random, 2, 0.6);
    const Ball j = some_ball(random, 1);
    if (!expect_same_in_any_units_nans_aside("Eq. (8.5)", box_ball, units::by_field, i, j)) return;
  }
}

EXERCISE_TEST(SeparatingAxis, IsTheSameInAnyUnits) {
  Random random;
  for (int k = 0; k < pairs_of_shapes; ++k) {
    const Box i = random_box(random, 2, 0.6);
    const Box j = random_box(random, 5, 0.6);
    if (!expect_same_in_any_units("Eq. (8.6), (8.7)", separating_axis, units::by_field, i, j)) return;
  }
  // Turned by little more than a millionth: its edges are not parallel, whatever is counted in which unit.
  const Box box = random_box(random, 1);
  Box other = turned(box, 1e-4, random.unit_vector());
  other.x += 0.1 * random.vector();
  expect_same_in_any_units("Eq. (8.7)", separating_axis, units::by_field, box, other);
}

EXERCISE_TEST(Clip, IsTheSameInAnyUnits) {
  using namespace units;
  const std::vector<Vec3> polygon = {{1, 0, 0}, {0, 1, 0.5}, {-1, 0, 0}, {0, -1, -0.5}};
  for (const double offset : {-3.0, -0.6, 0.0, 0.3, 2.0})
    expect_same_in_any_units("Eq. (8.8)", clip, m, polygon * m, Vec3(0.6, 0, 0.8), offset * m);
}

EXERCISE_TEST(EdgeContact, IsTheSameInAnyUnits) {
  Random random;
  const Box i = random_box(random, 2);
  const Box j = random_box(random, 5);
  const Vec3 n = i.axes.col(1).cross(j.axes.col(2)).normalized();
  const SeparatingAxis axis{.n = n.dot(j.x - i.x) < 0 ? Vec3(-n) : n, .gap = -0.01, .edge_i = 1, .edge_j = 2};
  expect_same_in_any_units("Eq. (8.9)", edge_contact, units::by_field, i, j, axis);
}

EXERCISE_TEST(BoxBox, IsTheSameInAnyUnits) {
  Random random;
  for (int k = 0; k < pairs_of_shapes; ++k) {
    const Box i = random_box(random, 2, 0.6);
    const Box j = random_box(random, 5, 0.6);
    if (!expect_same_in_any_units_nans_aside("Eq. (8.6)-(8.10)", box_box, units::nothing, i, j,
                                             std::vector<Contact>{}))
      return;
  }
}

EXERCISE_TEST(Bounds, IsTheSameInAnyUnits) {
  Random random;
  expect_same_in_any_units("Eq. (8.11)", bounds, units::by_field, random_box(random, 1));
}

EXERCISE_TEST(SweepAndPrune, IsTheSameInAnyUnits) {
  Random random;
  expect_same_in_any_units("Eq. (8.12)", sweep_and_prune, units::pure, some_bounds(random));
}

EXERCISE_TEST(SpatialHash, IsTheSameInAnyUnits) {
  Random random;
  expect_same_in_any_units("Eq. (8.13), (8.14)", spatial_hash, units::pure, some_bounds(random));
}

}  // namespace
