// A ball on a plane, and two balls: the gap, the normal, and the point that both bodies share.
#include "relative_scales.hpp"
#include "shapes.hpp"

using namespace spook;
using namespace spook::testing;

namespace {

EXERCISE(PlaneBall, "8.1 plane_ball");
EXERCISE(BallBall, "8.2 ball_ball");

bool expect_some(const std::string& what, const std::string& equation, const std::optional<Contact>& contact,
                 const std::string& clue = "A contact is what has g <= 0.") {
  expect_true(what + " have a contact", equation, contact.has_value(), clue);
  return contact.has_value();
}

EXERCISE_TEST(PlaneBall, PressesIntoTheFloor) {
  given() =
      "given the floor z < 1 of body 7, whose centre is (2, 3, -5), and a ball of radius 0.5 at (4, 5, 1.4)";
  const Plane floor{.body = 7, .x = Vec3(2, 3, -5), .n = Vec3::UnitZ(), .offset = 1};
  const auto found = plane_ball(floor, {.body = 3, .x = Vec3(4, 5, 1.4), .radius = 0.5});
  if (!expect_some(
          "they", "Eq. (8.1)", found,
          "The centre is 1.4 - 1 = 0.4 m above the plane, and the ball's surface is 0.5 m closer: g = -0.1 m. "
          "Return no contact only for g > 0."))
    return;
  expect_contact(
      "ball in the floor", "Eq. (8.1), (8.3)", *found,
      {7, 3, Vec3::UnitZ(), -0.1, Vec3(4, 5, 0.9), floor.x, Vec3(4, 5, 1.4)},
      {{0.1, "This is a depth. The gap has a sign, and is negative where they overlap."},
       {0.9, "The offset is missing: the plane is at n·x = offset."},
       {0.4, "This is the height of the centre. Subtract the radius."},
       {5.9, "This is measured from the centre of the plane's body; the offset is from the origin."},
       {-1.1, "The offset is subtracted twice, or the diameter in place of the radius."}},
      {{Vec3(4, 5, 1), "This is on the plane. p is the ball's deepest point."},
       {Vec3(4, 5, 0.95), "This is the middle of the overlap. Against a plane p is the ball's deepest point."},
       {Vec3(4, 5, 1.9), "This is the ball's highest point: p is R below its centre, against n."},
       {Vec3(6, 8, -4.1), "r_i is a lever arm, from the centre of the plane's body to p: p - x_i."},
       {Vec3(6, 8, -5.1),
        "r_i begins at a point of the plane. It is a lever arm, from the centre of the plane's body to p: p - "
        "x_i."},
       {Vec3(4, 5, 1.4), "This is the ball's centre. p is R from it, against n."}});
}

EXERCISE_TEST(PlaneBall, FollowsAnyPlane) {
  Random random;
  for (int trial = 0; trial < 200 && !::testing::Test::HasFailure(); ++trial) {
    const Vec3 x = random.vector(3), centre = random.vector(3);
    const Vec3 n = random.unit_vector();
    const double radius = random.uniform(0.1, 2);
    // Centres below the plane, too: everything behind it is solid.
    const double gap = random.uniform(-2 * radius - 1, 0);
    const Plane plane{.body = 0, .x = x, .n = n, .offset = n.dot(centre) - radius - gap};
    const auto found = plane_ball(plane, {.body = 1, .x = centre, .radius = radius});
    if (!expect_some("a plane and a ball with g = " + show(gap) + " m", "Eq. (8.1)", found,
                     "Everything behind a plane is solid, at any depth."))
      return;
    expect_contact(
        "random plane and ball", "Eq. (8.1), (8.3)", *found, {0, 1, n, gap, centre - radius * n, x, centre},
        {{-gap, "This is a depth: the gap is negative where they overlap."},
         {gap + radius, "This is the height of the centre: subtract the radius."},
         {n.dot(centre - x) - plane.offset - radius,
          "The offset is from the origin, not from the plane's body."},
         {std::abs(gap + radius) - radius,
          "This is the absolute height. Below the plane n·x - offset is "
          "negative."}},
        {{Vec3(centre + radius * n), "p is R from the ball's centre against n."},
         {Vec3(centre - (radius + gap) * n), "This is on the plane: p is the ball's deepest point."}});
  }
}

EXERCISE_TEST(PlaneBall, TouchesFromZeroGapOn) {
  const Plane floor{.body = 0, .x = Vec3::Zero(), .n = Vec3::UnitZ(), .offset = -2};
  const auto at = [&](double z) { return plane_ball(floor, {.body = 1, .x = Vec3(7, 0, z), .radius = 0.5}); };
  expect_true("a ball that just touches, g = 0, has a contact", "Eq. (8.1)", at(-1.5).has_value(),
              "g <= 0: exactly zero counts.");
  expect_true("a ball that is 1e-12 m above the floor has none", "Eq. (8.1)", !at(-1.5 + 1e-12).has_value(),
              "Only g <= 0 is a contact.");
  expect_true("a ball that is 1 m above the floor has none", "Eq. (8.1)", !at(-0.5).has_value(),
              "Only g <= 0 is a contact.");
  expect_true("a ball at NaN has none", "Eq. (8.1)", !at(std::nan("")).has_value(),
              "`if (!(gap <= 0))`, and not `if (gap > 0)`, stops a NaN.");
}

EXERCISE_TEST(PlaneBall, DropsNothingSmall) {
  for (const double part : relative_scales)
    for (const Vec3& leaning : lopsided(part)) {
      const Vec3 n = leaning.normalized();
      const auto found = plane_ball({.body = 0, .x = Vec3::Zero(), .n = n, .offset = 0},
                                    {.body = 1, .x = Vec3::Zero(), .radius = 0.5});
      if (!expect_some("a plane and a ball in it", "Eq. (8.1)", found)) return;
      for (const Vec3& arm : {found->r_i, found->r_j})
        expect_each_near<Vec3>("arm of a ball on a plane that leans a little [m]", "Eq. (8.3)", arm, -0.5 * n,
                               8);
      if (::testing::Test::HasFailure()) return;
    }
}

EXERCISE_TEST(PlaneBall, CountsWhatIsSmall) {
  // One or two of the ball's place, its radius and the plane's offset are small.
  for (const double part : relative_scales)
    for (const auto& [z, radius, offset] : {std::tuple(1.0, part, 2.0),
                                            {part, 1.0, 0.5},
                                            {1.0, 2.0, part},
                                            {part, 1.0, 0.0},
                                            {part, part, 1.0}}) {
      const auto found = plane_ball({.body = 0, .x = Vec3::Zero(), .n = Vec3::UnitZ(), .offset = offset},
                                    {.body = 1, .x = Vec3(0, 0, z), .radius = radius});
      if (!expect_some("a plane and a ball in it", "Eq. (8.1)", found)) return;
      const std::string of = " of a ball of radius " + show(radius) + " m at a height of " + show(z) +
                             " m, in a plane at " + show(offset) + " m [m]";
      expect_near("gap" + of, "Eq. (8.1)", found->gap, z - offset - radius, roundings(8), {}, small_is_dropped);
      expect_near("height of its deepest point" + of, "Eq. (8.3)", found->r_i.z(), z - radius, roundings(4), {},
                  small_is_dropped);
      if (::testing::Test::HasFailure()) return;
    }
}

EXERCISE_TEST(PlaneBall, GapChangesAtTheRateOfItsRow) {
  Random random;
  const Vec3 n = random.unit_vector(), x = random.vector(3);
  const Drift still, moving(random);
  const Plane plane{.body = 0, .x = random.vector(3), .n = n, .offset = n.dot(x) - 0.4};
  const Ball ball{.body = 1, .x = x, .radius = 0.5};
  const auto found = plane_ball(plane, ball);
  if (!expect_some("a plane and a ball, 0.1 m deep,", "Eq. (8.1)", found)) return;
  expect_rate(*found, still, moving, [&](double t) { return plane_ball(plane, moving.after(t, ball))->gap; });
}

EXERCISE_TEST(BallBall, OverlapInTheMiddle) {
  given() = "given body 4, a ball of radius 2 at (1, 1, 1), and body 9, one of radius 0.5 at (1, 1, 3.3)";
  const Ball i{.body = 4, .x = Vec3(1, 1, 1), .radius = 2}, j{.body = 9, .x = Vec3(1, 1, 3.3), .radius = 0.5};
  const auto found = ball_ball(i, j);
  if (!expect_some("they", "Eq. (8.2)", found,
                   "The centres are 2.3 m apart, the radii together 2.5 m: g = -0.2 m. Return no contact only "
                   "for g > 0."))
    return;
  expect_contact(
      "two balls", "Eq. (8.2), (8.3)", *found, {4, 9, Vec3::UnitZ(), -0.2, Vec3(1, 1, 2.9), i.x, j.x},
      {{0.2, "This is a depth. The gap has a sign, and is negative where they overlap."},
       {2.3, "This is the distance of the centres: subtract both radii."},
       {0.3, "Only R_i is subtracted."},
       {1.8, "Only R_j is subtracted."},
       {5.29 - 6.25, "These are squares: the gap is a length."}},
      {{Vec3(1, 1, 3),
        "This is on i's surface. p is in the middle of the overlap, half a gap from each surface."},
       {Vec3(1, 1, 2.8),
        "This is on j's surface. p is in the middle of the overlap, half a gap from each surface."},
       {Vec3(1, 1, 2.15), "This is in the middle between the centres. p is in the middle of the overlap."},
       {Vec3(1, 1, 3.1), "p is in the overlap: g is negative, so p is half a gap behind i's surface."}});
}

EXERCISE_TEST(BallBall, FollowsAnyTwo) {
  Random random;
  for (int trial = 0; trial < 200 && !::testing::Test::HasFailure(); ++trial) {
    const Ball i{.body = 1, .x = random.vector(3), .radius = random.uniform(0.1, 2)};
    const double radius = random.uniform(0.1, 2);
    const double distance = random.uniform(0.01, 1) * (i.radius + radius), gap = distance - i.radius - radius;
    const Vec3 n = random.unit_vector();
    const Ball j{.body = 0, .x = i.x + distance * n, .radius = radius};
    const auto found = ball_ball(i, j);
    if (!expect_some("balls with g = " + show(gap) + " m", "Eq. (8.2)", found)) return;
    const double size = 1 + i.x.norm() + j.x.norm();
    expect_near("gap of random balls [m]", "Eq. (8.2)", found->gap, gap, roundings(64, size),
                {{-gap, "This is a depth: the gap is negative where they overlap."},
                 {distance - i.radius, "Only R_i is subtracted."},
                 {-2 * std::min(i.radius, radius),
                  "This is the smaller diameter. A ball within another has the gap of Eq. (8.2), too."}});
    expect_near_vector("n of random balls", "Eq. (8.2)", found->n, n, roundings(64, size / distance),
                       {{Vec3(-n), "n points from i to j: this is from j to i."},
                        {Vec3(distance * n), "This has the length of the distance: n is a unit vector."}});
    if (::testing::Test::HasFailure()) return;
    expect_near_vector(
        "point of random balls, x_i + r_i [m]", "Eq. (8.2), (8.3)", Vec3(i.x + found->r_i),
        Vec3(i.x + (i.radius + gap / 2) * n), roundings(256, size * 4 / std::min(1.0, distance)),
        {{Vec3(i.x + i.radius * n), "This is on i's surface: p is in the middle of the overlap."},
         {Vec3(i.x + distance / 2 * n), "This is in the middle between the centres, not of the overlap."}});
    expect_true(
        "i = 1 and j = 0; here i = " + std::to_string(found->i) + " and j = " + std::to_string(found->j),
        "Eq. (8.2)", found->i == 1 && found->j == 0, "Keep the order of the bodies.");
    if (!expect_common_point(*found, i.x, j.x)) return;
  }
}

EXERCISE_TEST(BallBall, TouchesFromZeroGapOn) {
  const auto at = [&](double x) {
    return ball_ball({.body = 0, .x = Vec3::Zero(), .radius = 1},
                     {.body = 1, .x = Vec3(0, x, 0), .radius = 0.5});
  };
  expect_true("balls that just touch, g = 0, have a contact", "Eq. (8.2)", at(1.5).has_value(),
              "g <= 0: exactly zero counts.");
  expect_true("balls that are 1e-12 m apart have none", "Eq. (8.2)", !at(1.5 + 1e-12).has_value(),
              "Only g <= 0 is a contact.");
  expect_true("balls that are 3 m apart have none", "Eq. (8.2)", !at(4.5).has_value(),
              "Only g <= 0 is a contact.");
  expect_true("a ball at NaN has none", "Eq. (8.2)", !at(std::nan("")).has_value(),
              "`if (!(gap <= 0))`, and not `if (gap > 0)`, stops a NaN.");
}

EXERCISE_TEST(BallBall, PartsCentresAtOnePlace) {
  Random random;
  const Vec3 x = random.vector(3);
  const auto found = ball_ball({.body = 0, .x = x, .radius = 1}, {.body = 1, .x = x, .radius = 0.25});
  if (!expect_some("balls with one centre", "Eq. (8.2)", found)) return;
  expect_near("gap of balls of radius 1 and 0.25 with one centre [m]", "Eq. (8.2)", found->gap, -1.25,
              roundings(4));
  expect_near("|n| of balls with one centre", "Eq. (8.2)", found->n.norm(), 1, roundings(8), {},
              "0/0 is NaN: where there is no direction, choose any.");
  expect_true("their arms are finite", "Eq. (8.3)", found->r_i.allFinite() && found->r_j.allFinite());
  expect_common_point(*found, x, x);
}

EXERCISE_TEST(BallBall, FollowsCentresThatAreNear) {
  Random random;
  for (const double distance : {1e-3, 1e-7, 1e-12, 1e-100}) {
    // At the origin, where x_j - x_i has no roundings but those of its own size.
    const Vec3 n = random.unit_vector();
    given() = "given balls of radius 1 and 0.25, the second's centre " + show(distance) +
              " m from the first's along\n" + show(n);
    const auto found =
        ball_ball({.body = 0, .x = Vec3::Zero(), .radius = 1}, {.body = 1, .x = distance * n, .radius = 0.25});
    if (!expect_some("they", "Eq. (8.2)", found)) return;
    expect_near_vector(
        "n", "Eq. (8.2)", found->n, n, roundings(16),
        {{Vec3(-n), "n points from i to j: this is from j to i."}},
        "Only centres at the same place have no direction. At any other distance n is along x_j - x_i, so that "
        "it stays continuous while the balls pass.");
    if (::testing::Test::HasFailure()) return;
  }
}

EXERCISE_TEST(BallBall, DropsNothingSmall) {
  for (const double part : relative_scales)
    for (const Vec3& leaning : lopsided(part)) {
      const Vec3 n = leaning.normalized();
      const auto found =
          ball_ball({.body = 0, .x = Vec3::Zero(), .radius = 1}, {.body = 1, .x = 1.5 * n, .radius = 0.75});
      if (!expect_some("two balls", "Eq. (8.2)", found)) return;
      expect_each_near<Vec3>("n of balls that are nearly side by side along an axis", "Eq. (8.2)", found->n, n,
                             8);
      expect_each_near<Vec3>("r_i of balls that are nearly side by side along an axis [m]", "Eq. (8.3)",
                             found->r_i, 0.875 * n, 16);
      expect_each_near<Vec3>("r_j of balls that are nearly side by side along an axis [m]", "Eq. (8.3)",
                             found->r_j, -0.625 * n, 16);
      if (::testing::Test::HasFailure()) return;
    }
}

EXERCISE_TEST(BallBall, CountsWhatIsSmall) {
  // One or two of the distance and the radii are small, or two are nearly equal. One of the centres is close to the
  // origin.
  for (const double part : relative_scales)
    for (const auto& [distance, one, other] : {std::tuple(1 - part, 1.0, 2 * part),
                                               {part, 1.0, 0.25},
                                               {part, 1.0, part},
                                               {0.25, 1.0, part},
                                               {1 - part, 1.0, 0.5},
                                               {1 + part, 1.0, 0.5}})
      for (const auto& [exchanged, at] : {std::pair(false, part), {true, part}, {false, part - distance}}) {
        const double R_i = exchanged ? other : one, R_j = exchanged ? one : other;
        const Ball i{.body = 0, .x = Vec3(0, 0, at), .radius = R_i},
            j{.body = 1, .x = Vec3(0, 0, at + distance), .radius = R_j};
        const auto found = ball_ball(i, j);
        const std::string of = " of balls of " + show(R_i) + " m and " + show(R_j) + " m, their centres " +
                               show(distance, 14) + " m apart [m]";
        const double gap = distance - R_i - R_j;
        if (!expect_some("balls with g = " + show(gap) + " m", "Eq. (8.2)", found)) return;
        expect_near("gap" + of, "Eq. (8.2)", found->gap, gap, roundings(8), {}, small_is_dropped);
        expect_near("height of their common point over the first's centre," + of, "Eq. (8.3)", found->r_i.z(),
                    R_i + gap / 2, roundings(8), {}, small_is_dropped);
        expect_near("height of their common point over the second's centre," + of, "Eq. (8.3)", found->r_j.z(),
                    -R_j - gap / 2, roundings(8), {}, small_is_dropped);
        if (::testing::Test::HasFailure()) return;
      }
}

EXERCISE_TEST(BallBall, GapChangesAtTheRateOfItsRow) {
  Random random;
  const Drift drift_i(random), drift_j(random);
  const Ball i{.body = 0, .x = random.vector(3), .radius = 0.8};
  const Ball j{.body = 1, .x = i.x + 1.2 * random.unit_vector(), .radius = 0.5};
  const auto found = ball_ball(i, j);
  if (!expect_some("balls, 0.1 m deep in each other,", "Eq. (8.2)", found)) return;
  expect_rate(*found, drift_i, drift_j,
              [&](double t) { return ball_ball(drift_i.after(t, i), drift_j.after(t, j))->gap; });
}

}  // namespace
