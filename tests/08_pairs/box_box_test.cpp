// Two boxes: faces that lie on each other, edges that cross, and contacts that round-off must not change.
#include <algorithm>
#include <numbers>

#include "boxes.hpp"
#include "regions.hpp"
#include "relative_scales.hpp"

using namespace spook;
using namespace spook::testing;

namespace {

EXERCISE(BoxBox, "8.8 box_box");

EXERCISE_TEST(BoxBox, LiesOnALargerOne) {
  const Box table = straight(3, Vec3(1, 2, 3), Vec3(2, 2, 1)),
            box = straight(8, Vec3(1.5, 2, 4.49), Vec3(0.5, 0.5, 0.5));
  given() = describe_both(table, box);
  const auto got = contacts_of(table, box);
  if (!expect_count("a box on a table", got, 4,
                    "The four corners of the lower face of j are under the table's top."))
    return;
  expect_points("a box on a table", table, box, got,
                {Vec3(1, 1.5, 3.995), Vec3(2, 1.5, 3.995), Vec3(1, 2.5, 3.995), Vec3(2, 2.5, 3.995)},
                Vec3::UnitZ(), -0.01);
}

EXERCISE_TEST(BoxBox, LiesOnAnyOfItsFaces) {
  // Any of its axes may be the vertical one, and the world may have any orientation.
  Random random;
  for (int up_i = 0; up_i < 3; ++up_i)
    for (int up_j = 0; up_j < 3; ++up_j)
      for (const int side : {1, -1}) {
        const Mat3 world = random.rotation().toRotationMatrix();
        // `half_sides` are those along x, y and z before the world is turned.
        const auto standing = [&](int body, int up, int which, const Vec3& x, const Vec3& half_sides) {
          Box box = straight(body, world * x, half_sides);
          for (int k = 0; k < 3; ++k) {
            const int along = (k + 2 - up + 3) % 3;
            box.axes.col(k) = world.col(along) * (along == 0 ? 1 : which);
            box.half_sides[k] = half_sides[along];
          }
          return box;
        };
        const Box table = standing(3, up_i, side, Vec3(1, 2, 3), Vec3(2, 3, 1)),
                  box = standing(8, up_j, -side, Vec3(1.5, 2, 4.29), Vec3(0.5, 0.4, 0.3));
        given() = describe_both(table, box);
        const std::string what = "a box, whose axis " + std::to_string(up_j) + " is vertical, on a table";
        const auto got = contacts_of(table, box);
        if (!expect_count(
                what, got, 4,
                "The four corners of the lower face of j, the one that looks most against n, are under "
                "the table's top."))
          return;
        std::vector<Vec3> wanted;
        for (const double x : {1.0, 2.0})
          for (const double y : {1.6, 2.4}) wanted.push_back(world * Vec3(x, y, 3.995));
        if (!expect_points(what, table, box, got, wanted, world.col(2), -0.01)) return;
      }
}

EXERCISE_TEST(BoxBox, CarriesALargerOne) {
  // Now the corners of i are under the face of j, and those of j hang over.
  for (const double size : {1.0, 1e-6}) {
    const Box stand = straight(3, size * Vec3(1, 2, 3), size * Vec3(0.5, 0.5, 1)),
              plate = straight(8, size * Vec3(1, 2, 4.24), size * Vec3(2, 2, 0.25));
    given() = describe_both(stand, plate);
    const auto got = contacts_of(stand, plate);
    if (!expect_count("a plate on a stand", got, 4,
                      "The lower face of j, cut by the sides of i, has four corners."))
      return;
    std::vector<Vec3> corners;
    for (const double x : {0.5, 1.5})
      for (const double y : {1.5, 2.5}) corners.push_back(size * Vec3(x, y, 3.995));
    if (!expect_points("a plate on a stand", stand, plate, got, corners, Vec3::UnitZ(), -0.01 * size, size))
      return;
  }
}

EXERCISE_TEST(BoxBox, MovesTheSidesOutByAMillionth) {
  // A plate on a stand, once with each of the six half sides as the smallest. Where the plate does not hang over, its
  // own corners stay.
  for (int smallest = 0; smallest < 6; ++smallest) {
    Box stand = straight(3, Vec3::Zero(), Vec3(0.5, 0.6, 0.8)),
        plate = straight(8, Vec3::Zero(), Vec3(2, 3, 0.7));
    (smallest < 3 ? stand : plate).half_sides[smallest % 3] = 0.2;
    plate.x.z() = stand.half_sides.z() + plate.half_sides.z() - 0.01;
    given() = describe_both(stand, plate);
    const auto got = contacts_of(stand, plate);
    if (!expect_count("a plate on a stand", got, 4,
                      "The lower face of j, cut by the sides of i, has four corners."))
      return;
    const double slack = 1e-6 * 0.2;
    for (int k = 0; k < 2; ++k)
      for (const Contact& contact : got) {
        const double side = stand.half_sides[k], hangs = plate.half_sides[k];
        expect_near(
            std::string("distance of a contact from the middle, along ") + "xy"[k] + " [m]", "Eq. (8.8)",
            std::abs(contact.r_i[k]), std::min(hangs, side + slack), roundings(64, 4),
            {{side, "The clipping planes are exactly on the sides. Move them outwards."},
             {side - slack, "The clipping planes have been moved inwards."}},
            "The overhang is clipped by the sides of i, moved outwards by a millionth of the smallest of the "
            "six half sides.");
        if (::testing::Test::HasFailure()) return;
      }
  }
}

EXERCISE_TEST(BoxBox, LeavesOutWhatIsAboveTheFaceByLittle) {
  // A cube that leans by 0.01 on a table: two corners of its lower face are deep, the other two hardly above the
  // table's top, or hardly below.
  const Box table = straight(3, Vec3(1, 2, 3), Vec3(2, 2, 1));
  for (const double above : {1e-7, 3e-7, 1e-8, 1e-10, -1e-7, -1e-10}) {
    Box cube = turned(straight(8, Vec3::Zero(), Vec3::Constant(0.5)), 0.01, Vec3::UnitY());
    double upper = -infinity, lower = infinity;  // of the lower face
    for (const double side : {-0.5, 0.5}) {
      const double z = (cube.axes * Vec3(side, 0, -0.5)).z();
      upper = std::max(upper, z), lower = std::min(lower, z);
    }
    cube.x = Vec3(1, 2, 4 - upper + above);
    given() = describe_both(table, cube);
    const auto got = contacts_of(table, cube);
    const std::string what = "a cube that leans on a table, two of its lower corners " + show(std::abs(above)) +
                             " m " + (above > 0 ? "above" : "below") + " the top";
    expect_near(
        "contacts of " + what, "Eq. (8.8)", static_cast<double>(got.size()), above > 0 ? 2 : 4, {0, "a count"},
        {{above > 0 ? 4.0 : 2.0,
          above > 0 ? "Corners slightly above the face that is met are kept, but only those with g <= 0 "
                      "may stay. The millionth is for the four sides around the face, not for the face "
                      "itself."
                    : "Corners slightly below the face that is met are left out. Keep all with g <= 0."}},
        "Keep the remaining corners with g <= 0.");
    for (const Contact& contact : got)
      expect_at_most("gap of a contact of " + what + " [m]", "Eq. (8.8)", contact.gap, 0, "g <= 0");
    if (::testing::Test::HasFailure()) return;
  }
}

EXERCISE_TEST(BoxBox, UsesTheDeepestCornerWhenClippingLeavesNothing) {
  // The face of j that looks down most leads from its lowest corner away from i. That corner is beside the top of i, by
  // more than the millionth by which sides are moved, and below it, by less than makes up for the head start that the
  // faces of i have. What overlaps is the other lower face, which is steeper.
  const Box i = straight(2, Vec3(1, 2, 3), Vec3::Constant(0.5));
  const double millionth = 1e-6 * 0.5;
  Box j = turned(straight(7, Vec3::Zero(), i.half_sides), 45.1 / 180 * std::numbers::pi, Vec3::UnitY());
  // One end of the lowest edge is the lower one, by 2 per cent of the millionth.
  j = turned(j, 1e-8, Vec3::UnitX());
  Vec3 lowest = Vec3::Zero();
  for (const Vec3& corner : corners(j))
    if (corner.z() < lowest.z()) lowest = corner;
  const Vec3 beside = i.x + Vec3(0.5 + 1.01 * millionth, lowest.y(), 0.5 - 1.08 * millionth);
  j.x = beside - lowest;
  given() = describe_both(i, j);
  const std::string what =
      "a cube on its edge, beside the rim of another, which overlap by less than a millionth";
  const auto got = contacts_of(i, j);
  expect_true(
      "contacts of " + what + ", " + std::to_string(got.size()) + ", are one or two", "Eq. (8.8)",
      got.size() == 1 || got.size() == 2,
      "They overlap along all fifteen axes. If clipping leaves nothing of the incident face, take the corner "
      "that is deepest along n, and the other end of its edge if it is as deep.");
  if (::testing::Test::HasFailure()) return;
  const spook::Contact& deepest = got.size() == 2 && got[1].gap < got[0].gap ? got[1] : got[0];
  expect_near(what + ": gap [m]", "Eq. (8.6)", deepest.gap, -1.08 * millionth, roundings(64, 4), {},
              "How far the deepest corner of j is in front of the face of i.");
  expect_near_vector(what + ": n", "Eq. (8.7)", deepest.n, Vec3(Vec3::UnitZ()), roundings(16));
  expect_near_vector(what + ": the point x_i + r_i [m]", "Eq. (8.3)", Vec3(i.x + deepest.r_i),
                     Vec3(beside + 0.54 * millionth * Vec3::UnitZ()), roundings(64, 4), {},
                     "p is the corner of j that is deepest along n, moved back by half a gap.");
  expect_common_point(deepest, i.x, j.x);
}

EXERCISE_TEST(BoxBox, DropsNothingSmall) {
  const Box table = straight(0, Vec3::Zero(), Vec3(2, 2, 1));
  const std::string turned_a_little = "a box that is turned, or shifted, a little on a table";
  for (const double part : relative_scales) {
    for (const Vec3& size : lopsided(part)) {
      const Vec3 h = size.cwiseAbs();
      const auto got = contacts_of(table, straight(1, Vec3(0, 0, 1 + 0.9 * h.z()), h));
      if (!expect_count("a needle on a table", got, 4, "The four corners of its lower face.")) return;
      for (const Contact& contact : got) {
        expect_each_near<Eigen::Vector2d>(
            "corner of a needle, from its centre, along x and y, without signs [m]", "Eq. (8.3), (8.8)",
            contact.r_j.head<2>().cwiseAbs(), h.head<2>(), 4);
        expect_each_near<Eigen::Vector2d>("the same from the table's centre, straight below [m]",
                                          "Eq. (8.3), (8.8)", contact.r_i.head<2>(), contact.r_j.head<2>(), 4);
      }
      if (::testing::Test::HasFailure()) return;
    }
    // Turned about the vertical by p, and shifted by p: each corner is 0.5 ± 0.25 p from the middle, and p more.
    const double c = std::cos(part), s = std::sin(part);
    const Box box = turned(straight(1, Vec3(part, -part, 1.25), Vec3(0.5, 0.25, 0.3)), part, Vec3::UnitZ());
    const auto got = contacts_of(table, box);
    if (!expect_count(turned_a_little, got, 4, "The four corners of its lower face.")) return;
    for (const double x : {-0.5, 0.5})
      for (const double y : {-0.25, 0.25}) {
        const Vec3 corner(c * x - s * y + part, s * x + c * y - part, 0.975);
        const auto nearest = std::min_element(got.begin(), got.end(), [&](const Contact& a, const Contact& b) {
          return (a.r_i - corner).norm() < (b.r_i - corner).norm();
        });
        expect_near_vector("r_i of the corner near " + show(corner) + " of " + turned_a_little + " [m]",
                           "Eq. (8.3), (8.8)", nearest->r_i, corner, roundings(32), {}, small_is_dropped);
      }
    if (::testing::Test::HasFailure()) return;
  }
}

EXERCISE_TEST(BoxBox, CountsWhatIsSmall) {
  // A box that hardly touches a table, and one whose lower face is hardly over the table's middle. The table is hardly
  // off the origin, or the box is.
  for (const double part : relative_scales)
    for (const double low : {1 - part, 2 * part})
      for (const Vec3& origin : {Vec3(0, 0, 0), Vec3(part, part, part + low + 0.5)}) {
        const Box table = straight(0, Vec3(part, part, part) - origin, Vec3(3, 3, 1)),
                  box = straight(1, Vec3(0, 0, low + 0.5) - origin, Vec3(0.5, 0.5, 0.5));
        const std::string what = "a box whose lower face is " + show(1 - low) + " m below a table's top";
        const auto got = contacts_of(table, box);
        if (!expect_count(what, got, 4, "The four corners of its lower face.")) return;
        for (const Contact& contact : got) {
          expect_near("gap of " + what + " [m]", "Eq. (8.6), (8.8)", contact.gap, low - 1 - part, roundings(8),
                      {}, small_is_dropped);
          expect_near("height of a contact over the table's centre, of " + what + " [m]", "Eq. (8.3)",
                      contact.r_i.z(), (low - part + 1) / 2, roundings(8), {}, small_is_dropped);
          expect_near("|x| of a contact, of " + what + ", from the box's centre [m]", "Eq. (8.3)",
                      std::abs(contact.r_i.x() + part), 0.5, roundings(8), {}, small_is_dropped);
        }
        if (::testing::Test::HasFailure()) return;
      }
}

EXERCISE_TEST(BoxBox, CountsWhatIsSmallInAPlate) {
  // A corner of a cube goes right through a plate that is thin beside its depth, or ends near the middle of one.
  const Box cube =
      turned(turned(straight(1, Vec3::Zero(), Vec3(0.5, 0.5, 0.5)), 0.7, Vec3::UnitX()), 0.5, Vec3::UnitY());
  Vec3 lowest = Vec3::Zero();
  for (const Vec3& corner : corners(cube))
    if (corner.z() < lowest.z()) lowest = corner;
  for (const double part : relative_scales)
    for (const auto& [half, corner] :
         {std::pair(part, Vec3(0.1, -0.1, -0.05)), {0.125, Vec3(part, -part, -part / 2)}}) {
      const Box plate = straight(0, Vec3::Zero(), Vec3(2, 2, half));
      Box above = cube;
      above.x = corner - lowest;
      const double gap = corner.z() - half;
      const std::string what =
          "a corner at " + show(corner) + " from the middle of a plate of 2 x " + show(half) + " m";
      const auto got = contacts_of(plate, above);
      if (!expect_count(what, got, 1, "One corner is behind the upper face of the plate.")) return;
      expect_near("gap of " + what + " [m]", "Eq. (8.6), (8.8)", got[0].gap, gap, roundings(64), {},
                  small_is_dropped);
      expect_near_vector("r_i of " + what + " [m]", "Eq. (8.3)", got[0].r_i,
                         Vec3(corner - gap / 2 * Vec3::UnitZ()), roundings(64), {}, small_is_dropped);
      if (::testing::Test::HasFailure()) return;
    }
}

EXERCISE_TEST(BoxBox, TouchesFromZeroGapOn) {
  const Box below = straight(0, Vec3::Zero(), Vec3(0.5, 0.5, 0.5));
  const auto at = [&](double z) {
    return static_cast<double>(contacts_of(below, straight(1, Vec3(0, 0, z), below.half_sides)).size());
  };
  expect_near("contacts of a cube that just touches another, g = 0", "Eq. (8.6), (8.8)", at(1), 4,
              {0, "a count"}, {}, "g <= 0: exactly zero counts.");
  expect_near("contacts of a cube that is 1e-12 m above another", "Eq. (8.6), (8.8)", at(1 + 1e-12), 0,
              {0, "a count"}, {}, "If there is a gap along any axis, there is no contact.");
  // Ridges that cross, where no corner is near: edges have a gap, too.
  const Box i = turned(below, std::numbers::pi / 4, Vec3::UnitX());
  Box j = turned(below, std::numbers::pi / 4, Vec3::UnitY());
  j.body = 1;
  for (const double apart : {1e-12, -1e-12}) {
    j.x.z() = std::sqrt(2.0) + apart;
    expect_near("contacts of two cubes whose ridges cross, " + show(std::abs(apart)) + " m " +
                    (apart > 0 ? "apart" : "deep"),
                "Eq. (8.6), (8.9)", static_cast<double>(contacts_of(i, j).size()), apart > 0 ? 0 : 1,
                {0, "a count"}, {},
                "Only g <= 0 is a contact, also where edges cross. If there is a gap along any axis, there is "
                "none.");
  }
}

EXERCISE_TEST(BoxBox, PiercesAThinPlate) {
  // Deeper than the plate is thick: its corner is a contact all the same, and only the four sides cut.
  const Box plate = straight(0, Vec3::Zero(), Vec3(2, 2, 0.01));
  Box cube =
      turned(turned(straight(1, Vec3::Zero(), Vec3(0.5, 0.5, 0.5)), 0.7, Vec3::UnitX()), 0.5, Vec3::UnitY());
  const double reach = (cube.axes.row(2).cwiseAbs() * cube.half_sides)(0);
  cube.x = Vec3(0.1, -0.1, reach + 0.01 - 0.05);
  given() = describe_both(plate, cube);
  Vec3 lowest = cube.x;
  for (const Vec3& corner : corners(cube))
    if (corner.z() < lowest.z()) lowest = corner;
  const auto got = contacts_of(plate, cube);
  if (!expect_count(
          "a corner that pierces a plate", got, 1,
          "One corner is behind the upper face of the plate. Clip by the four sides around that face, not by "
          "the face itself or its opposite."))
    return;
  expect_points("a corner that pierces a plate", plate, cube, got, {Vec3(lowest + 0.025 * Vec3::UnitZ())},
                Vec3::UnitZ(), -0.05);
}

EXERCISE_TEST(BoxBox, HangsOverTheRim) {
  for (const double out : {0.5, 1.0, 1.5}) {
    const Box table = straight(0, Vec3::Zero(), Vec3(2, 2, 1)),
              box = straight(1, Vec3(1 + out, 0.5, 1.99), Vec3(1, 1, 1));
    given() = describe_both(table, box);
    const auto got = contacts_of(table, box);
    const std::string what = "a box " + show(out) + " m of whose 2 m hang over the rim";
    if (!expect_count(what, got, 4, "Cut the lower face by the four sides around the upper one.")) return;
    if (!expect_points(
            what, table, box, got,
            {Vec3(out, -0.5, 0.995), Vec3(out, 1.5, 0.995), Vec3(2, -0.5, 0.995), Vec3(2, 1.5, 0.995)},
            Vec3::UnitZ(), -0.01))
      return;
  }
}

EXERCISE_TEST(BoxBox, PutsACornerOfIOnAFaceOfJ) {
  // Turned so that the face that is met is j's: i stands on a corner of it.
  Random random;
  for (int trial = 0; trial < 100 && !::testing::Test::HasFailure(); ++trial) {
    Box j = random_box(random, 1), i = straight(0, Vec3::Zero(), Vec3(0.3, 0.4, 0.5));
    j.half_sides = Vec3(2, 2, 1);
    const int side = random.integer(0, 1) ? 1 : -1;
    // The corner of i that is farthest along w touches the face of j that looks along -w, and no other does.
    const Vec3 w = -side * j.axes.col(2), seen = i.axes.transpose() * w;
    if (seen.cwiseAbs().minCoeff() < 0.2) continue;
    const Vec3 corner =
        i.axes * Vec3(std::copysign(0.3, seen[0]), std::copysign(0.4, seen[1]), std::copysign(0.5, seen[2]));
    const double along = random.uniform(-1, 1), aside = random.uniform(-1, 1);
    j.x = corner + (1 - 0.002) * w + along * j.axes.col(0) + aside * j.axes.col(1);
    given() = describe_both(i, j);
    const auto got = contacts_of(i, j);
    if (!expect_count("a corner of i in a face of j", got, 1,
                      "One corner of the incident face is behind the face of j; "
                      "those with g > 0 are no contacts."))
      return;
    if (!expect_points("a corner of i in a face of j", i, j, got, {Vec3(corner - 0.001 * w)}, w, -0.002))
      return;
  }
}

EXERCISE_TEST(BoxBox, EdgesCrossAtAPoint) {
  const double half = 0.5, ridge = half * std::sqrt(2.0), depth = 0.02;
  const Box cube = straight(4, Vec3(1, -1, 2), Vec3::Constant(half));
  const Box i = turned(cube, std::numbers::pi / 4, Vec3::UnitX());
  Box j = turned(cube, std::numbers::pi / 4, Vec3::UnitY());
  j.body = 9;
  j.x += Vec3(0.1, -0.2, 2 * ridge - depth);
  given() = describe_both(i, j);
  const auto got = contacts_of(i, j);
  if (!expect_count("two ridges that cross", got, 1,
                    "One contact, where the two edges are nearest to each other."))
    return;
  expect_points("two ridges that cross", i, j, got, {cube.x + Vec3(0.1, 0, ridge - depth / 2)}, Vec3::UnitZ(),
                -depth);
}

/// The middle between two random edges that cross at a random angle, which are all that meets.
EXERCISE_TEST(BoxBox, EdgesCrossAtAnyAngle) {
  Random random;
  int looked_at = 0;
  for (int trial = 0; trial < 400 && !::testing::Test::HasFailure(); ++trial) {
    const Box i = random_box(random, 0);
    Box j = random_box(random, 1);
    const int a = random.integer(0, 2), b = random.integer(0, 2);
    Vec3 n = i.axes.col(a).cross(j.axes.col(b));
    if (n.norm() < 0.3) continue;
    n = (random.integer(0, 1) ? n : -n).normalized();
    const auto middle = [](const Box& box, int along, const Vec3& out) {
      Vec3 r = Vec3::Zero();
      for (int k = 0; k < 3; ++k)
        if (k != along) r += std::copysign(box.half_sides[k], out.dot(box.axes.col(k))) * box.axes.col(k);
      return r;
    };
    const Vec3 on_i = i.x + middle(i, a, n) + random.uniform(-0.15, 0.15) * i.axes.col(a);
    const double depth = 1e-3;
    j.x = on_i - depth * n - middle(j, b, -n) + random.uniform(-0.15, 0.15) * j.axes.col(b);
    const auto got = contacts_of(i, j);
    const auto axis = separating_axis(i, j);
    if (axis.edge_i != a || axis.edge_j != b) continue;  // something else meets, or is as near
    if (is_nearly_flat(i, j, axis.n)) continue;
    ++looked_at;
    given() = describe_both(i, j);
    if (!expect_count("two edges that cross", got, 1,
                      "One contact, where the two edges are nearest to each other."))
      return;
    if (!expect_points("two edges that cross", i, j, got, {Vec3(on_i - depth / 2 * n)}, n, -depth)) return;
  }
  expect_at_least("pairs of edges that were looked at", "Eq. (8.9)", looked_at, 20, "a good many of 400");
}

EXERCISE_TEST(BoxBox, ContactsAreWhereTheBoxesAre) {
  Random random;
  int touching = 0;
  for (int trial = 0; trial < 1000 && !::testing::Test::HasFailure(); ++trial) {
    const Box i = random_box(random, 0);
    Box j = random_box(random, 1, 2);
    contacts_of(i, j);
    // Along the line of their centres to where they overlap by 1 per cent of the smallest half side.
    const Vec3 line = (j.x - i.x).normalized();
    const double depth = 0.01 * std::min(i.half_sides.minCoeff(), j.half_sides.minCoeff());
    double deep = 0, apart = 5;
    for (int halving = 0; halving < 50; ++halving) {
      const double middle = (deep + apart) / 2;
      j.x = i.x + middle * line;
      (separating_axis(i, j).gap < -depth ? deep : apart) = middle;
    }
    j.x = i.x + deep * line;
    given() = describe_both(i, j);
    const auto got = contacts_of(i, j);
    const auto axis = separating_axis(i, j);
    expect_at_least("contacts of boxes that overlap", "Eq. (8.8)", static_cast<double>(got.size()), 1,
                    "at least one");
    expect_at_most("contacts of boxes", "Eq. (8.8)", static_cast<double>(got.size()), 8, "at most eight",
                   "Four cuts of a polygon with four corners leave eight at most.");
    if (::testing::Test::HasFailure()) return;
    ++touching;
    for (const Contact& contact : got) {
      const bool on_a_flat_face = axis.edge_i >= 0 && got.size() >= 2;
      if (on_a_flat_face)
        expect_at_least("cosine of the angle between n of a contact and the axis of two edges",
                        "Eq. (8.7), (8.9)", contact.n.dot(axis.n), 0.99, "a face within 8 degrees of it",
                        "Edges have one contact; only a face that is nearly flat has more.");
      else
        expect_near_vector(
            "n of a contact", "Eq. (8.7)", contact.n, axis.n, roundings(16),
            {{Vec3(-axis.n), "n points from i to j: where the face is j's its outward normal is -n."}},
            "The separating axis.");
      expect_at_most("gap of a contact [m]", "Eq. (8.8)", contact.gap, 0, "those with g <= 0 stay",
                     "A corner in front of the face that is met is not a contact.");
      // Seen along a face's normal the crossing of two edges is deeper by the inverse cosine of 8 degrees.
      expect_at_least("gap of a contact [m]", "Eq. (8.6)", contact.gap,
                      on_a_flat_face ? axis.gap / 0.99 - 1e-6 : axis.gap - 1e-12,
                      "that along the axis: nothing is deeper", "Measure from the face that is met, along n.");
      const Vec3 p = i.x + contact.r_i;
      const Vec3 half = contact.gap / 2 * contact.n;
      const std::string clue =
          "p is in the middle between the two surfaces, and the gap is what is between them there.";
      const std::string why = "on it; a millionth of its sides for the planes that cut";
      expect_at_most("distance of p - gap/2 n from i [m]", "Eq. (8.3), (8.8)", distance(i, p - half), 4e-6, why,
                     clue);
      expect_at_most("distance of p + gap/2 n from j [m]", "Eq. (8.3), (8.8)", distance(j, p + half), 4e-6, why,
                     clue);
      if (::testing::Test::HasFailure() || !expect_common_point(contact, i.x, j.x)) return;
    }
  }
  expect_at_least("pairs that were looked at", "Eq. (8.8)", touching, 500, "most");
}

EXERCISE_TEST(BoxBox, BoxesApartHaveNone) {
  Random random;
  for (int trial = 0; trial < 200 && !::testing::Test::HasFailure(); ++trial) {
    const Box i = random_box(random, 0);
    Box j = random_box(random, 1);
    j.x = i.x + (i.half_sides.norm() + j.half_sides.norm() + 1e-9) * random.unit_vector();
    const Contact other{
        .i = 8, .j = 9, .n = Vec3::UnitX(), .gap = -1, .r_i = Vec3::Zero(), .r_j = Vec3::Zero()};
    std::vector<Contact> contacts = {other};
    box_box(i, j, contacts);
    given() = describe_both(i, j);
    expect_near("contacts, with one of another pair, of boxes that are apart", "Eq. (8.7)",
                static_cast<double>(contacts.size()), 1, {0, "a count"},
                {{0, "The earlier entries of `contacts` are lost: append."}},
                "If there is a gap along any axis, there is no contact.");
  }
}

EXERCISE_TEST(BoxBox, KeepsWhatWasFoundBefore) {
  const Box below = straight(0, Vec3::Zero(), Vec3(1, 1, 1)),
            above = straight(1, Vec3(0, 0, 1.9), Vec3(1, 1, 1));
  for (const auto& [i, j] : {std::pair(below, above), std::pair(above, below)}) {
    given() = describe_both(i, j);
    std::vector<Contact> contacts = contacts_of(i, j);
    const std::vector<Contact> before = contacts;
    const auto alone = static_cast<double>(contacts.size());
    box_box(i, j, contacts);
    expect_near("contacts, after the same pair a second time", "Eq. (8.8)",
                static_cast<double>(contacts.size()), 2 * alone, {0, "a count"},
                {{alone, "The earlier entries of `contacts` are lost: append."}},
                "Whatever was in the list before stays.");
    if (::testing::Test::HasFailure()) return;
    for (std::size_t k = 0; k < before.size(); ++k)
      expect_true("contact " + std::to_string(k) + ", which was there before, is still as it was", "Eq. (8.8)",
                  contacts[k].i == before[k].i && contacts[k].j == before[k].j &&
                      contacts[k].n == before[k].n && contacts[k].r_i == before[k].r_i &&
                      contacts[k].r_j == before[k].r_j,
                  "Append, and exchange the bodies of the new ones only.");
  }
}

struct Position {
  std::string what;
  Box i, j;
};

/// The exact positions that boxes have in scenes.
std::vector<Position> common_positions() {
  const Box cube = straight(0, Vec3::Zero(), Vec3(0.5, 0.5, 0.5));
  const auto on = [&](double x, double y, const Vec3& half_sides) {
    return straight(1, Vec3(x, y, 0.5 + half_sides.z() - 1e-3), half_sides);
  };
  const Vec3 equal = cube.half_sides;
  const Box octagon = turned(on(0, 0, equal), std::numbers::pi / 4, Vec3::UnitZ());
  const Box ridge =
      turned(straight(1, Vec3(0, 0, 0.5 + std::sqrt(0.5) - 1e-3), equal), std::numbers::pi / 4, Vec3::UnitX());
  // Tipped about x, so that its sides are still in line, and half of its lower face is below.
  const double tip = 0.01, down = 0.5 * (std::cos(tip) + std::sin(tip));
  const Box tipping = turned(straight(1, Vec3(0, 0, 0.495 + down), equal), tip, Vec3::UnitX());
  return {{"a cube that has begun to tip on an equal one", cube, tipping},
          {"a cube squarely on an equal one", cube, on(0, 0, equal)},
          {"a cube on a larger box", straight(0, Vec3(0, 0, -0.5), Vec3(2, 2, 1)), on(0, 0, equal)},
          {"a plate on a cube", cube, on(0, 0, Vec3(2, 2, 0.1))},
          {"a cube on an equal one, turned by 45 degrees", cube, octagon},
          {"a cube half over the rim", cube, on(0.5, 0, equal)},
          {"a cube half over a corner", cube, on(0.5, 0.5, equal)},
          {"a brick on two, its end on the seam", straight(0, Vec3::Zero(), Vec3(1, 0.5, 0.5)),
           on(1, 0, Vec3(1, 0.5, 0.5))},
          {"a cube that hangs on by its edge, as deep in x as in z", cube, on(1 - 1e-3, 0, equal)},
          {"a cube on its edge", cube, ridge}};
}

/// Returns the least difference between the contact and one of `others`: in point, gap and normal, added.
double nearest(const Contact& contact, const std::vector<Contact>& others) {
  double least = infinity;
  for (const Contact& other : others)
    least = std::min(least, (contact.r_i - other.r_i).norm() + std::abs(contact.gap - other.gap) +
                                (contact.n - other.n).norm());
  return least;
}

EXERCISE_TEST(BoxBox, ChangesLittleWhenItsBoxesMoveLittle) {
  Random random;
  for (const auto& [what, i, j] : common_positions()) {
    const auto still = contacts_of(i, j);
    given() = describe_both(i, j);
    expect_at_least("contacts of " + what, "Eq. (8.8)", static_cast<double>(still.size()), 1, "it touches");
    if (::testing::Test::HasFailure()) return;
    for (int trial = 0; trial < 200 && !::testing::Test::HasFailure(); ++trial) {
      Box moved = j;
      moved.x += random.vector(1e-9);
      const double angle = random.uniform(-1e-9, 1e-9);
      if (trial % 2) moved = turned(moved, angle, random.unit_vector());
      const auto now = contacts_of(i, moved);
      expect_near("contacts of " + what + ", moved by 1e-9 m", "Eq. (8.8), (8.10)",
                  static_cast<double>(now.size()), static_cast<double>(still.size()),
                  {0, "their number without"}, {},
                  "Round-off decides where sides lie on each other. Move the clipping planes outwards by a "
                  "millionth of the smallest half side.");
      if (::testing::Test::HasFailure()) return;
      double farthest = 0;
      for (const Contact& contact : now) farthest = std::max(farthest, nearest(contact, still));
      expect_at_most("how far a contact of " + what + " has gone, where a box has moved by 1e-9 m",
                     "Eq. (8.8), (8.10)", farthest, 1e-7,
                     "points, gaps and normals move with the boxes; 1e-9 m and rad, and a few times that",
                     "Round-off has chosen another face, another edge, or other contacts of many.");
    }
  }
}

EXERCISE_TEST(BoxBox, IsIndependentOfTheArgumentOrder) {
  Random random;
  std::vector<Position> positions = common_positions();
  Regions regions({"a face of i is met", "a face of j is met", "two edges are met", "j has the lower number"},
                  30);
  while (regions.lack_draws()) {
    const int number = random.integer(0, 1);
    const Box one = random_box(random, number, 0.7), other = random_box(random, 1 - number, 0.7);
    positions.push_back({"random boxes", one, other});
    const SeparatingAxis axis = separating_axis(one, other);
    const bool touch = axis.gap <= 0;
    regions.draw({{"a face of i is met", touch && axis.face_i >= 0},
                  {"a face of j is met", touch && axis.face_j >= 0},
                  {"two edges are met", touch && axis.edge_i >= 0},
                  {"j has the lower number", number == 1}});
  }
  for (const auto& [what, i, j] : positions) {
    const auto one = contacts_of(i, j), other = contacts_of(j, i);
    given() = describe_both(i, j);
    expect_near("contacts of box_box(j, i), for " + what, "Eq. (8.8)", static_cast<double>(other.size()),
                static_cast<double>(one.size()), {0, "as many as box_box(i, j) has"}, {},
                "Wherever the two boxes are treated differently, let the box with the lower body number be i.");
    if (::testing::Test::HasFailure()) return;
    for (const Contact& contact : other) {
      expect_true("box_box(j, i) has i = " + std::to_string(contact.i) + ", j = " + std::to_string(contact.j),
                  "Eq. (8.8)", contact.i == j.body && contact.j == i.body, "i is the first argument's body.");
      const Contact back{.i = contact.j,
                         .j = contact.i,
                         .n = -contact.n,
                         .gap = contact.gap,
                         .r_i = contact.r_j,
                         .r_j = contact.r_i};
      expect_at_most(
          "how far a contact of box_box(j, i) is from one of box_box(i, j), for " + what, "Eq. (8.8)",
          nearest(back, one), 1e-9, "roundings",
          "The same points and gaps, with n reversed: wherever the boxes are treated differently, let the one "
          "with the lower body number be i, and exchange the bodies again at the end.");
      if (::testing::Test::HasFailure()) return;
    }
  }
}

EXERCISE_TEST(BoxBox, MeetsTheFaceOfTheLowerNumber) {
  // Two faces that are alike to 5 per cent of the gap: that of the lower body number is met, in either order.
  const Box table = straight(4, Vec3::Zero(), Vec3(0.5, 0.5, 0.5));
  Box box = turned(straight(7, Vec3(0, 0, 0.9), Vec3(0.5, 0.5, 0.5)), 1e-3, Vec3(1, 2, 0));
  for (const int number : {7, 2}) {
    box.body = number;
    const Vec3 face = number == 7 ? Vec3(Vec3::UnitZ()) : Vec3(box.axes.col(2));
    for (const bool table_first : {true, false}) {
      const Box &i = table_first ? table : box, &j = table_first ? box : table;
      given() = "given i, body " + std::to_string(i.body) + ", " + describe(i) + "\nand j, body " +
                std::to_string(j.body) + ", " + describe(j);
      const auto got = contacts_of(i, j);
      if (!expect_count("two cubes, nearly square on each other", got, 4, "All of one face is over the other."))
        return;
      expect_near_vector(
          "n", "Eq. (8.7)", got[0].n, Vec3(table_first ? face : -face), roundings(64),
          {{Vec3(table_first ? -face : face), "n points from i to j."}},
          "If both faces are equally good, take that of the box with the lower body number, in either order of "
          "the arguments.");
      if (::testing::Test::HasFailure()) return;
    }
  }
}

EXERCISE_TEST(BoxBox, GapChangesAtTheRateOfItsRow) {
  Random random;
  // A corner of j in a face of i, and edges that cross: points of the bodies, which stay where they are on them.
  const double ridge = 0.5 * std::sqrt(2.0);
  const Box cube = straight(0, Vec3(1, -1, 2), Vec3::Constant(0.5));
  Box corner = turned(turned(cube, 0.7, Vec3::UnitX()), 0.5, Vec3::UnitY());
  corner.body = 1;
  const double reach = (corner.axes.row(2).cwiseAbs() * corner.half_sides)(0);
  corner.x += Vec3(0.1, -0.1, 0.5 + reach - 0.01);
  const Box below = turned(cube, std::numbers::pi / 4, Vec3::UnitX());
  Box above = turned(cube, std::numbers::pi / 4, Vec3::UnitY());
  above.body = 1;
  above.x += Vec3(0.1, -0.2, 2 * ridge - 0.02);
  for (const auto& [what, i, j] :
       {Position{"a corner in a face", cube, corner}, Position{"edges", below, above}}) {
    given() = "given " + what + ": " + describe_both(i, j);
    const auto found = contacts_of(i, j);
    if (!expect_count(what, found, 1, "One corner, or one crossing, is all that meets.")) return;
    const Drift drift_i(random), drift_j(random);
    expect_rate(found[0], drift_i, drift_j, [&, &i = i, &j = j](double t) {
      const auto later = contacts_of(drift_i.after(t, i), drift_j.after(t, j));
      return later.size() == 1 ? later[0].gap : std::nan("");
    });
  }
}

EXERCISE_TEST(BoxBox, IsTheSameFarFromTheOrigin) {
  const Vec3 far(1048576, -2097152, 524288);
  for (const auto& [what, i, j] : common_positions()) {
    Box far_i = i, far_j = j;
    far_i.x += far;
    far_j.x += far;
    // Adding `far` rounds x_j, but the difference of the two is exact: around it the boxes are where these are.
    Box near_i = i, near_j = j;
    near_i.x = Vec3::Zero();
    near_j.x = far_j.x - far_i.x;
    const auto near = contacts_of(near_i, near_j), there = contacts_of(far_i, far_j);
    given() = describe_both(far_i, far_j);
    const std::string clue =
        "Use positions relative to the centre of one box. Far from the origin x_j - x_i is exact, but p - x "
        "has "
        "few digits.";
    expect_near("contacts of " + what + ", 2000 km away", "Eq. (8.8)", static_cast<double>(there.size()),
                static_cast<double>(near.size()), {0, "as many as at the origin"}, {}, clue);
    if (::testing::Test::HasFailure()) return;
    for (const Contact& contact : there)
      expect_at_most("how far a contact of " + what + ", 2000 km away, is from where it is at the origin [m]",
                     "Eq. (8.8)", nearest(contact, near), 1e-13,
                     "roundings of the boxes, not of where they are", clue);
    if (::testing::Test::HasFailure()) return;
  }
}

}  // namespace
