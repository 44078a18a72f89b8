// A box on a plane, and a box that a ball touches.
#include <algorithm>

#include "regions.hpp"
#include "relative_scales.hpp"
#include "shapes.hpp"

using namespace spook;
using namespace spook::testing;

namespace {

EXERCISE(PlaneBox, "8.3 plane_box");
EXERCISE(BoxBall, "8.4 box_ball");

// Expects one contact for each corner of the box at or behind the plane, and no others.
bool expect_corners(const Plane& plane, const Box& box, const std::vector<Contact>& got) {
  std::vector<Vec3> deep;
  for (const Vec3& corner : corners(box))
    if (plane.n.dot(corner) - plane.offset <= 0) deep.push_back(corner);
  const auto count = static_cast<double>(deep.size());
  expect_near("contacts of a box with so many corners at or behind the plane", "Eq. (8.4)",
              static_cast<double>(got.size()), count, {0, "a count"},
              {{8 - count, "These are the corners in front of the plane: a contact has g <= 0."},
               {8, "A contact is what has g <= 0: corners in front of the plane are none."},
               {1, "A box may stand on several corners: every one that has g <= 0 is a contact."}},
              "Eight corners, x ± h_1 e_1 ± h_2 e_2 ± h_3 e_3; each with g <= 0 is a contact.");
  if (::testing::Test::HasFailure()) return false;
  const auto opposite_axes = [&](const Vec3& p) {  // the same corner, if rows were axes
    return Vec3(box.x + box.axes.transpose() * (box.axes.transpose() * (p - box.x)));
  };
  for (const Vec3& corner : deep) {
    const auto nearest = std::min_element(got.begin(), got.end(), [&](const Contact& a, const Contact& b) {
      return (box.x + a.r_j - corner).norm() < (box.x + b.r_j - corner).norm();
    });
    const double gap = plane.n.dot(corner) - plane.offset;
    expect_near_vector(
        "point of the contact nearest to the corner " + show(corner) + ", x_j + r_j [m]", "Eq. (8.3), (8.4)",
        Vec3(box.x + nearest->r_j), corner, roundings(64, 8),
        {{Vec3(corner - gap * plane.n), "This is on the plane: p is the corner itself."},
         {Vec3(corner - gap / 2 * plane.n), "This is half way to the plane: p is the corner itself."},
         {opposite_axes(corner), "The axes are the columns of `axes`: these are its rows."}},
        "The corners are x ± h_1 e_1 ± h_2 e_2 ± h_3 e_3, and r_j is from the box's centre.");
    if (::testing::Test::HasFailure()) return false;
    if (!expect_contact(
            "corner " + show(corner), "Eq. (8.3), (8.4)", *nearest,
            {plane.body, box.body, plane.n, gap, corner, plane.x, box.x},
            {{-gap, "This is a depth: the gap is negative behind the plane."},
             {gap + plane.offset, "The offset is missing: the plane is at n·x = offset."},
             {plane.n.dot(corner - plane.x) - plane.offset,
              "The offset is from the origin, not from the plane's body."},
             {plane.n.dot(box.x) - plane.offset, "This is the height of the centre, not of the corner."}},
            {{Vec3(plane.x + nearest->r_j), "r_i begins at the plane's body: p - x_i."},
             {Vec3(corner - gap * plane.n), "This is on the plane: both arms end at p, the corner itself."}}))
      return false;
  }
  return true;
}

EXERCISE_TEST(PlaneBox, StandsOnFourCorners) {
  const Plane floor{.body = 5, .x = Vec3(3, 0, -1), .n = Vec3::UnitZ(), .offset = 0.25};
  const Box box{.body = 2, .x = Vec3(1, 2, 1.2), .axes = Mat3::Identity(), .half_sides = Vec3(0.5, 2, 1)};
  given() = "given the floor z < 0.25 of a body at (3, 0, -1), and " + describe(box);
  std::vector<Contact> contacts;
  plane_box(floor, box, contacts);
  expect_corners(floor, box, contacts);
}

EXERCISE_TEST(PlaneBox, FindsTheCornersOfAnyBox) {
  Random random;
  for (int trial = 0; trial < 200 && !::testing::Test::HasFailure(); ++trial) {
    const Box box = random_box(random, 1, 3);
    const Vec3 n = random.unit_vector();
    const Plane plane{
        .body = 0, .x = random.vector(3), .n = n, .offset = n.dot(box.x) + random.uniform(-1.5, 1.5)};
    given() = "given a plane n = " + show(n) + ", offset " + show(plane.offset) + ", of a body at " +
              show(plane.x) + ", and " + describe(box);
    std::vector<Contact> contacts;
    plane_box(plane, box, contacts);
    if (!expect_corners(plane, box, contacts)) return;
  }
}

EXERCISE_TEST(PlaneBox, KeepsWhatWasFoundBefore) {
  const Plane floor{.body = 0, .x = Vec3::Zero(), .n = Vec3::UnitZ(), .offset = 0};
  const Box box{.body = 1, .x = Vec3(0, 0, 1), .axes = Mat3::Identity(), .half_sides = Vec3(1, 1, 1)};
  const Contact other{.i = 8, .j = 9, .n = Vec3::UnitX(), .gap = -1, .r_i = Vec3::Zero(), .r_j = Vec3::Zero()};
  std::vector<Contact> contacts = {other};
  plane_box(floor, box, contacts);
  expect_near("contacts, after one of another pair, of a box that just touches the floor, g = 0", "Eq. (8.4)",
              static_cast<double>(contacts.size()), 5, {0, "a count"},
              {{4, "The earlier entries of `contacts` are lost: append."},
               {1, "g <= 0: corners exactly on the plane count."}});
  if (::testing::Test::HasFailure()) return;
  expect_true("the contact that was there before stays first", "Eq. (8.4)",
              contacts[0].i == 8 && contacts[0].j == 9, "Append.");
  plane_box(floor, {.body = 2, .x = Vec3(0, 0, 1.5), .axes = Mat3::Identity(), .half_sides = Vec3(1, 1, 1)},
            contacts);
  expect_near("contacts, after one more box, which doesn't touch", "Eq. (8.4)",
              static_cast<double>(contacts.size()), 5, {0, "a count"}, {}, "A contact is what has g <= 0.");
}

EXERCISE_TEST(PlaneBox, TouchesFromZeroGapOn) {
  const Plane floor{.body = 0, .x = Vec3::Zero(), .n = Vec3::UnitZ(), .offset = 0};
  const auto at = [&](double z) {
    std::vector<Contact> contacts;
    plane_box(floor, {.body = 1, .x = Vec3(3, 0, z), .axes = Mat3::Identity(), .half_sides = Vec3(1, 1, 1)},
              contacts);
    return static_cast<double>(contacts.size());
  };
  expect_near("contacts of a box on the floor, g = 0", "Eq. (8.4)", at(1), 4, {0, "a count"}, {},
              "g <= 0: exactly zero counts.");
  expect_near("contacts of a box that is 1e-12 m above the floor", "Eq. (8.4)", at(1 + 1e-12), 0,
              {0, "a count"}, {}, "Only g <= 0 is a contact.");
  expect_near("contacts of a box at NaN", "Eq. (8.4)", at(std::nan("")), 0, {0, "a count"}, {},
              "`if (gap <= 0)`, and not `if (!(gap > 0))`, stops a NaN.");
}

EXERCISE_TEST(PlaneBox, GapChangesAtTheRateOfItsRow) {
  Random random;
  const Box box = random_box(random, 1);
  const Drift still, moving(random);
  const Vec3 n = random.unit_vector();
  const Plane plane{.body = 0, .x = random.vector(), .n = n, .offset = n.dot(box.x) + 5};  // all eight are deep
  std::vector<Contact> contacts;
  plane_box(plane, box, contacts);
  expect_near("contacts of a box that is all behind the plane", "Eq. (8.4)",
              static_cast<double>(contacts.size()), 8, {0, "a count"});
  if (::testing::Test::HasFailure()) return;
  for (const Contact& contact : contacts) {
    // The corner is a point of the box: it turns with it.
    const Vec3 seen = box.axes.transpose() * contact.r_j;
    expect_rate(contact, still, moving, [&](double t) {
      const Box later = moving.after(t, box);
      return n.dot(later.x + later.axes * seen) - plane.offset;
    });
    if (::testing::Test::HasFailure()) return;
  }
}

bool expect_some(const std::optional<Contact>& contact,
                 const std::string& clue = "A contact is what has g <= 0.") {
  expect_true("the box and the ball have a contact", "Eq. (8.5)", contact.has_value(), clue);
  return contact.has_value();
}

EXERCISE_TEST(PlaneBox, DropsNothingSmall) {
  for (const double part : relative_scales)
    for (const Vec3& size : lopsided(part)) {
      const Vec3 half_sides = size.cwiseAbs();
      std::vector<Contact> found;
      plane_box({.body = 0, .x = Vec3::Zero(), .n = Vec3::UnitZ(), .offset = 2},
                {.body = 1, .x = Vec3::Zero(), .axes = Mat3::Identity(), .half_sides = half_sides}, found);
      expect_near("contacts of a needle that is all behind a plane", "Eq. (8.4)",
                  static_cast<double>(found.size()), 8, {0, "its corners"});
      for (const Contact& contact : found) {
        expect_each_near<Vec3>("arm of a needle's corner, without its signs [m]", "Eq. (8.3), (8.4)",
                               contact.r_j.cwiseAbs(), half_sides, 4);
        expect_each_near<Vec3>("the same corner from the plane's body, at the same place [m]",
                               "Eq. (8.3), (8.4)", contact.r_i, contact.r_j, 4);
      }
      if (::testing::Test::HasFailure()) return;
    }
}

EXERCISE_TEST(PlaneBox, CountsWhatIsSmall) {
  // The box's place, its half sides, the plane's offset, or the difference of two of them is small.
  for (const double part : relative_scales)
    for (const auto& [z, half_sides, offset] : {std::tuple(1.0, Vec3(1, 1, part), 2.0),
                                                {1.0, Vec3(part, part, part), 2.0},
                                                {part, Vec3(1, 1, 1), 2.0},
                                                {1.0, Vec3(1, 1, 2), part},
                                                {1 + part, Vec3(1, 1, 1), 2.0}}) {
      const Box box{.body = 1, .x = Vec3(0, 0, z), .axes = Mat3::Identity(), .half_sides = half_sides};
      std::vector<Contact> found;
      plane_box({.body = 0, .x = Vec3::Zero(), .n = Vec3::UnitZ(), .offset = offset}, box, found);
      const double half = half_sides.z();
      const std::string of = " of a box of height " + show(2 * half) + " m, its centre at " + show(z, 14) +
                             " m, in a plane at " + show(offset) + " m [m]";
      double lowest = infinity, deepest = infinity;
      for (const Contact& contact : found) {
        lowest = std::min(lowest, contact.r_i.z());
        deepest = std::min(deepest, contact.gap);
      }
      expect_near("height of the lowest corner" + of, "Eq. (8.3)", lowest, z - half, roundings(4), {},
                  small_is_dropped);
      expect_near("gap of the lowest corner" + of, "Eq. (8.4)", deepest, z - half - offset, roundings(8), {},
                  small_is_dropped);
      if (::testing::Test::HasFailure()) return;
    }
}

EXERCISE_TEST(BoxBall, MeetsAFaceAnEdgeAndACorner) {
  const Box box{.body = 6, .x = Vec3(1, 2, 3), .axes = Mat3::Identity(), .half_sides = Vec3(1, 2, 3)};
  struct Case {
    std::string what;
    Vec3 c, n;  // nearest point, from the centre of the box
  };
  for (const auto& [what, c, n] : std::vector<Case>{{"face", Vec3(0.5, 0.7, 3), Vec3(0, 0, 1)},
                                                    {"face", Vec3(-1, 0.7, 0), Vec3(-1, 0, 0)},
                                                    {"edge", Vec3(0.25, -2, 3), Vec3(0, -0.6, 0.8)},
                                                    {"corner", Vec3(1, 2, -3), Vec3(2, 1, -2) / 3}}) {
    const Ball ball{.body = 2, .x = box.x + c + 0.4 * n, .radius = 0.5};
    given() =
        "given body 6, a box at (1, 2, 3) with half sides (1, 2, 3) along x, y and z, and body 2, a ball of "
        "radius 0.5 at " +
        show(ball.x);
    const auto found = box_ball(box, ball);
    if (!expect_some(found)) return;
    const int axis = static_cast<int>(std::abs(n.z()) == 1 ? 2 : 0);
    const Vec3 from_centre = (ball.x - box.x).normalized();
    expect_near_vector(
        what + " and ball: n", "Eq. (8.5)", found->n, n, roundings(64),
        {{Vec3(-n), "n points from the box, i, to the ball, j."},
         {from_centre, "This is from the centre of the box. n is from the box's nearest point to the ball."},
         {Vec3(Vec3::Unit(axis)), "Beside an edge or a corner n is not a face's normal: it is along x_j - c."},
         {Vec3(0.4 * n), "This has the length of the distance: n is a unit vector."}},
        "c is the ball's centre with each coordinate along the box's axes cut off at ± h_k.");
    if (::testing::Test::HasFailure()) return;
    expect_contact(
        what + " and ball", "Eq. (8.3), (8.5)", *found, {6, 2, n, -0.1, box.x + c - 0.05 * n, box.x, ball.x},
        {{0.1, "This is a depth. The gap has a sign, and is negative where they overlap."},
         {0.4, "This is the distance of the centre: subtract the radius."},
         {-0.34, "This is the square of the distance, less R."}},
        {{Vec3(box.x + c), "This is on the box. p is in the middle of the overlap."},
         {Vec3(box.x + c - 0.1 * n), "This is on the ball. p is in the middle of the overlap."},
         {Vec3(box.x + c + 0.05 * n), "The gap is negative: from the box's surface p is back along n."}});
    if (::testing::Test::HasFailure()) return;
  }
}

EXERCISE_TEST(BoxBall, MeetsAnyBoxFromOutside) {
  Random random;
  const std::string into =
      "g = |x_j - c| - R, with c the box's nearest point to x_j: turn x_j - x_i into the box's axes with the "
      "transpose of `axes`, and c back with `axes`.";
  Regions regions({"beside a face, touching", "beside an edge, touching", "beside a corner, touching",
                   "beside a face, apart", "beside an edge, apart", "beside a corner, apart"},
                  50);
  while (regions.lack_draws()) {
    const Box box = random_box(random, 0);
    const Ball ball{.body = 1, .x = box.x + random.vector(2), .radius = random.uniform(0.2, 1)};
    const auto found = box_ball(box, ball);
    const double apart = distance(box, ball.x);
    if (apart < 1e-6 || std::abs(apart - ball.radius) < 1e-9) continue;
    const Vec3 seen = (box.axes.transpose() * (ball.x - box.x)).cwiseAbs() - box.half_sides;
    const auto beside = (seen.array() > 0).count();
    const bool touch = apart <= ball.radius;
    regions.draw({{"beside a face, touching", beside == 1 && touch},
                  {"beside an edge, touching", beside == 2 && touch},
                  {"beside a corner, touching", beside == 3 && touch},
                  {"beside a face, apart", beside == 1 && !touch},
                  {"beside an edge, apart", beside == 2 && !touch},
                  {"beside a corner, apart", beside == 3 && !touch}});
    given() = "given a ball of radius " + show(ball.radius) + " at " + show(ball.x) + " and " + describe(box);
    expect_true("a contact if the distance less R is at most 0; it is " + show(apart - ball.radius) +
                    " m, and there is " + std::string(found ? "a contact" : "no contact"),
                "Eq. (8.5)", found.has_value() == (apart <= ball.radius), into);
    if (!found || ::testing::Test::HasFailure()) continue;
    expect_near("gap [m]", "Eq. (8.5)", found->gap, apart - ball.radius, roundings(64, 4), {}, into);
    // From the ball's centre, |x_j - c| against n, is a point of the box.
    expect_near("|n|", "Eq. (8.5)", found->n.norm(), 1, roundings(64 / apart));
    const Vec3 c = ball.x - apart * found->n;
    expect_near("distance of x_j - |x_j - c| n, the nearest point, from the box [m]", "Eq. (8.5)",
                distance(box, c), 0, roundings(256, 4), {},
                "n is from the box's nearest point to the ball's centre, turned into the world.");
    if (::testing::Test::HasFailure()) return;
    expect_near_vector(
        "the point x_i + r_i [m]", "Eq. (8.3), (8.5)", Vec3(box.x + found->r_i),
        Vec3(ball.x - (ball.radius + found->gap / 2) * found->n), roundings(256, 4),
        {{c, "This is on the box: p is in the middle of the overlap."},
         {Vec3(ball.x - ball.radius * found->n), "This is on the ball: p is in the middle of the overlap."},
         {Vec3(c + found->gap / 2 * (box.axes.transpose() * found->n)),
          "A part of it is along the axes of the box: turn all of p into the world."}},
        "p is on the line along n through the ball's centre, half way between the two surfaces.");
    if (!expect_common_point(*found, box.x, ball.x)) return;
  }
}

EXERCISE_TEST(BoxBall, LeavesThroughTheNearestFace) {
  Random random;
  for (int trial = 0; trial < 200 && !::testing::Test::HasFailure(); ++trial) {
    const Box box = random_box(random, 0);
    const Vec3 seen = Vec3(random.vector(0.95).cwiseProduct(box.half_sides));
    const Ball ball{.body = 1, .x = box.x + box.axes * seen, .radius = random.uniform(0.1, 1)};
    given() = "given a ball of radius " + show(ball.radius) + " with its centre in " + describe(box) + "\nat " +
              show(seen) + " along the axes of the box";
    const Vec3 depth = box.half_sides - seen.cwiseAbs();
    int axis, largest;
    depth.minCoeff(&axis);
    seen.cwiseAbs().maxCoeff(&largest);
    Vec3 rest = depth;
    rest[axis] = 10;
    if (rest.minCoeff() < depth[axis] + 1e-6) continue;  // as near to another face
    const auto found = box_ball(box, ball);
    if (!expect_some(found, "A ball whose centre is in the box touches it, for any radius.")) return;
    const auto out = [&](int k) { return Vec3((seen[k] < 0 ? -1 : 1) * box.axes.col(k)); };
    expect_near_vector(
        "n of a ball within", "Eq. (8.5)", found->n, out(axis), roundings(16),
        {{Vec3(-out(axis)),
          "This pulls it through the box: n is the outward normal of the nearest face. Mind the sign of the "
          "coordinate."},
         {out(largest), "The largest coordinate is not the nearest face: compare h_k - |coordinate|."},
         {Vec3(ball.x - box.x).normalized(),
          "This is the direction from the centre of the box. Take the normal of the nearest face."}},
        "The nearest face is that with the least h_k - |coordinate|.");
    if (::testing::Test::HasFailure()) return;
    const double gap = -depth[axis] - ball.radius;
    expect_contact(
        "ball within", "Eq. (8.3), (8.5)", *found,
        {0, 1, out(axis), gap, ball.x + (depth[axis] + gap / 2) * out(axis), box.x, ball.x},
        {{-ball.radius, "The distance of the centre from the face is missing: the ball must cover it, too."},
         {depth[axis] - ball.radius, "Inside the box the distance from the face is negative."},
         {-gap, "This is a depth: the gap is negative."}},
        {{Vec3(ball.x + depth[axis] * out(axis)), "This is on the face: p is in the middle of the overlap."}});
  }
}

EXERCISE_TEST(BoxBall, LeavesFromTheMiddle) {
  // A coordinate of 0 has no sign, and either face is as near.
  const Box box{.body = 0, .x = Vec3(1, 2, 3), .axes = Mat3::Identity(), .half_sides = Vec3(2, 1, 3)};
  for (const Vec3& seen : {Vec3(0, 0, 0), Vec3(0.5, 0, -2), Vec3(-0.5, -0.0, 0)}) {
    given() = "given a box with half sides (2, 1, 3) along x, y and z, and a ball of radius 0.5 at " +
              show(seen) + " from its centre";
    const auto found = box_ball(box, {.body = 1, .x = box.x + seen, .radius = 0.5});
    if (!expect_some(found, "A ball whose centre is in the box touches it, for any radius.")) return;
    expect_near(
        "|n·e_2|, of the nearest two faces", "Eq. (8.5)", std::abs(found->n.y()), 1, roundings(4),
        {{0, found->n.isZero(0)
                 ? "The sign of a coordinate of 0 is neither 1 nor -1, but n must be a face's normal here, too."
                 : "This is along another axis. The nearest face is that with the least h_k - |coordinate|."}},
        "The nearest faces are those across y, 1 m away.");
    expect_near("gap [m]", "Eq. (8.5)", found->gap, -1.5, roundings(16));
    if (::testing::Test::HasFailure()) return;
    expect_near_vector(
        "the point x_i + r_i [m]", "Eq. (8.3), (8.5)", Vec3(box.x + found->r_i),
        Vec3(box.x + seen + 0.25 * found->n), roundings(64, 8),
        {{Vec3(box.x + seen - 0.75 * found->n),
          "This is half a gap from the ball's centre: c is on the face."}},
        "p is in the middle between the face, 1 m along n from the ball's centre, and the ball's "
        "farthest point, 0.5 m against n.");
    if (::testing::Test::HasFailure() || !expect_common_point(*found, box.x, Vec3(box.x + seen))) return;
  }
}

EXERCISE_TEST(BoxBall, FollowsACentreThatIsNearACorner) {
  const Box box{.body = 0, .x = Vec3::Zero(), .axes = Mat3::Identity(), .half_sides = Vec3(1, 1, 1)};
  for (const Vec3& way : {Vec3(2, -1, 2), Vec3(0, 3, -4), Vec3(12, 3, 4)})
    for (const double distance : {1e-2, 1e-7, 1e-9}) {
      const Vec3 n = way.normalized(), corner = n.cwiseSign();
      const Ball ball{.body = 1, .x = corner + distance * n, .radius = 0.5};
      given() = "given a cube of 2 m around the origin, and a ball of radius 0.5 whose centre is " +
                show(distance) + " m from the cube's\nedge or corner " + show(corner) + ", along " + show(n);
      const auto found = box_ball(box, ball);
      if (!expect_some(found)) return;
      expect_near_vector("n", "Eq. (8.5)", found->n, n,
                         {1e-15 / distance, "roundings of x_j, over its distance"}, {},
                         "Only a centre in the box, or on it, is pushed out along a face's normal. Outside, at "
                         "any distance, n is along x_j - c.");
      if (::testing::Test::HasFailure()) return;
    }
}

EXERCISE_TEST(BoxBall, GoesSmoothlyThroughTheSurface) {
  Random random;
  for (int trial = 0; trial < 50 && !::testing::Test::HasFailure(); ++trial) {
    Box box = random_box(random, 0);
    if (trial < 10) box.axes = Mat3::Identity();  // exactly on the surface, too
    const int axis = random.integer(0, 2);
    Vec3 seen = random.vector(0.5).cwiseProduct(box.half_sides);
    seen[axis] = box.half_sides[axis];
    for (const double out : {1e-9, 1e-15, 0.0, -1e-15, -1e-9}) {
      const Ball ball{.body = 1, .x = box.x + box.axes * seen + out * box.axes.col(axis), .radius = 0.3};
      const auto found = box_ball(box, ball);
      if (!expect_some(found,
                       "The centre is on the surface, where x_j - c has no direction: treat it as within."))
        return;
      const std::string where = " of a ball whose centre is " + show(out) + " m out of a face";
      expect_near("gap" + where + " [m]", "Eq. (8.5)", found->gap, out - 0.3, roundings(64, 4));
      expect_near_vector(
          "n" + where, "Eq. (8.5)", found->n, Vec3(box.axes.col(axis)), roundings(64), {},
          "x_j - c is at right angles to the face: subtract along the box's axes, where two of the "
          "three differences are exactly 0. On the surface there is no direction: take the face's.");
      if (::testing::Test::HasFailure()) return;
    }
  }
}

EXERCISE_TEST(BoxBall, TouchesFromZeroGapOn) {
  const Box box{.body = 0, .x = Vec3(0, 0, 2), .axes = Mat3::Identity(), .half_sides = Vec3(1, 1, 1)};
  const auto at = [&](double z) { return box_ball(box, {.body = 1, .x = Vec3(0, 0, z), .radius = 0.5}); };
  expect_true("a ball that just touches, g = 0, has a contact", "Eq. (8.5)", at(3.5).has_value(),
              "g <= 0: exactly zero counts.");
  expect_true("a ball that is 1e-12 m away has none", "Eq. (8.5)", !at(3.5 + 1e-12).has_value(),
              "Only g <= 0 is a contact.");
  expect_true("a ball that is 1 m away has none", "Eq. (8.5)", !at(4.5).has_value(),
              "Only g <= 0 is a contact.");
  expect_true("a ball at NaN has none", "Eq. (8.5)", !at(std::nan("")).has_value(),
              "`if (!(gap <= 0))`, and not `if (gap > 0)`, stops a NaN.");
}

EXERCISE_TEST(BoxBall, DropsNothingSmall) {
  const Box cube{.body = 0, .x = Vec3::Zero(), .axes = Mat3::Identity(), .half_sides = Vec3::Constant(0.875)};
  for (const double part : relative_scales)
    for (const Vec3& beside : lopsided(part)) {
      const auto found = box_ball(cube, {.body = 1, .x = beside, .radius = 0.5});
      if (!expect_some(found)) return;
      const auto at_face = [&](double height) {  // under the ball's centre
        return Vec3((beside.array() == 1).select(height, beside));
      };
      expect_each_near<Vec3>("r_i of a ball on a cube, near the middle of its face [m]", "Eq. (8.3), (8.5)",
                             found->r_i, at_face(0.6875), 4);
      if (::testing::Test::HasFailure()) return;
    }
}

EXERCISE_TEST(BoxBall, CountsWhatIsSmall) {
  // A ball just over a face, and a grain within.
  const Box cube{.body = 0, .x = Vec3::Zero(), .axes = Mat3::Identity(), .half_sides = Vec3::Constant(1)};
  for (const double part : relative_scales)
    for (const auto& [z, radius] : {std::pair(1 + part, 0.5), {0.75, part}}) {
      const auto found = box_ball(cube, {.body = 1, .x = Vec3(0, 0, z), .radius = radius});
      if (!expect_some(found)) return;
      expect_near(
          "gap of a ball of radius " + show(radius) + " m, its centre " + show(z - 1) + " m over a face [m]",
          "Eq. (8.5)", found->gap, z - 1 - radius, roundings(8), {}, small_is_dropped);
      if (::testing::Test::HasFailure()) return;
    }
}

EXERCISE_TEST(BoxBall, GapChangesAtTheRateOfItsRow) {
  Random random;
  for (int trial = 0; trial < 30 && !::testing::Test::HasFailure(); ++trial) {
    const Box box = random_box(random, 0);
    const Drift drift_i(random), drift_j(random);
    // Beside a face, an edge, a corner, or within; 0.1 m from where that changes.
    Vec3 seen;
    for (int k = 0; k < 3; ++k)
      seen[k] = random.integer(0, 1) ? random.uniform(-0.1, 0.1) : box.half_sides[k] + random.uniform(0.1, 0.3);
    const Ball ball{.body = 1, .x = box.x + box.axes * seen, .radius = 1};
    const auto found = box_ball(box, ball);
    if (!expect_some(found)) return;
    if (distance(box, ball.x) == 0 && std::abs((box.half_sides - seen.cwiseAbs()).minCoeff() -
                                               (box.half_sides - seen.cwiseAbs()).maxCoeff()) < 0.5)
      continue;  // two faces may be as near
    expect_rate(*found, drift_i, drift_j,
                [&](double t) { return box_ball(drift_i.after(t, box), drift_j.after(t, ball))->gap; });
  }
}

}  // namespace
