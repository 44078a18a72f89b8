// Clipping of polygons.
#include <algorithm>
#include <numbers>

#include "relative_scales.hpp"
#include "shapes.hpp"

using namespace spook;
using namespace spook::testing;

namespace {

EXERCISE(Clip, "8.6 clip");

/// Vector area: half the sum of the cross products. Its length is the area of a flat polygon whose corners are in
/// order.
Vec3 area(const std::vector<Vec3>& polygon) {
  Vec3 sum = Vec3::Zero();
  for (std::size_t k = 0; k < polygon.size(); ++k)
    sum += (polygon[k] - polygon[0]).cross(polygon[(k + 1) % polygon.size()] - polygon[0]) / 2;
  return sum;
}

const std::vector<Vec3> square = {Vec3(-1, -1, 0), Vec3(1, -1, 0), Vec3(1, 1, 0), Vec3(-1, 1, 0)};

bool expect_count(const std::string& what, const std::vector<Vec3>& got, int count, const std::string& clue) {
  expect_near("corners of " + what, "Eq. (8.8)", static_cast<double>(got.size()), count, {0, "a count"}, {},
              clue);
  return !::testing::Test::HasFailure();
}

EXERCISE_TEST(Clip, CutsASquare) {
  for (const double offset : {-0.5, 0.0, 0.25}) {
    given() = "given the square with corners (±1, ±1, 0), cut at x <= " + show(offset);
    const std::vector<Vec3> left = clip(square, Vec3::UnitX(), offset);
    const double right = 2 * (1 - offset), whole = 2 * (1 + offset);
    if (!expect_count("a square that is cut in two", left, 4,
                      "Two corners stay, and each of the two sides that are "
                      "cut gives another."))
      return;
    expect_near("its area [m²]", "Eq. (8.8)", area(left).norm(), whole, roundings(32, 4),
                {{right,
                  "This is the part to remove: n·x <= offset stays. Or the offset has the wrong sign, or t is "
                  "measured from the wrong end."},
                 {4, "The polygon has not been clipped."}},
                "A side from a to b is cut at a + t (b - a), t = height_a/(height_a - height_b).");
    if (::testing::Test::HasFailure()) return;
  }
}

EXERCISE_TEST(Clip, KeepsAllOrNothing) {
  const std::vector<Vec3> all = clip(square, Vec3::UnitX(), 2);
  if (!expect_count("a square that is all on the inner side", all, 4,
                    "All corners have n·x <= offset: they stay."))
    return;
  for (std::size_t k = 0; k < 4; ++k)
    expect_true("corner " + show(square[k]) + " is still there", "Eq. (8.8)",
                std::find(all.begin(), all.end(), square[k]) != all.end(), "Corners inside do not change.");
  expect_count("a square that is all on the outer side", clip(square, Vec3::UnitX(), -2), 0,
               "No point has n·x <= offset, so nothing remains.");
}

EXERCISE_TEST(Clip, KeepsACornerOnThePlaneOnce) {
  const Vec3 n = Vec3(1, -1, 0).normalized();
  const std::vector<Vec3> half = clip(square, n, 0);
  if (!expect_count(
          "half a square, cut along its diagonal", half, 3,
          "Two corners are on the plane: they stay, and no side is cut there. A side is cut only where one "
          "end has n·x < offset, and the other n·x > offset."))
    return;
  expect_near("its area [m²]", "Eq. (8.8)", area(half).norm(), 2, roundings(32, 4));
  if (!expect_count("a square with a side on the plane, inside", clip(square, Vec3::UnitX(), 1), 4,
                    "Corners on the plane stay, each once."))
    return;
  const std::vector<Vec3> line = clip(square, Vec3::UnitX(), -1);
  expect_count("a square with a side on the plane, outside", line, 2,
               "Only the two corners on the plane have n·x <= offset; each stays once.");
  expect_count("a square that is all on the plane", clip(square, Vec3::UnitZ(), square[0].z()), 4,
               "All corners have n·x <= offset, and stay.");
}

/// A convex polygon of n corners in a random plane.
std::vector<Vec3> random_polygon(Random& random, int n, double size) {
  const Vec3 normal = random.unit_vector(), centre = random.vector(size);
  const auto [t1, t2] = tangents(normal);
  std::vector<double> angles;
  for (int k = 0; k < n; ++k) angles.push_back(2 * std::numbers::pi * (k + random.uniform(0, 0.8)) / n);
  std::vector<Vec3> polygon;
  for (const double angle : angles)
    polygon.push_back(centre + size * (std::cos(angle) * t1 + 0.6 * std::sin(angle) * t2));
  return polygon;
}

EXERCISE_TEST(Clip, CutsAnyPolygonInTwo) {
  Random random;
  int cut = 0;
  for (int trial = 0; trial < 500 && !::testing::Test::HasFailure(); ++trial) {
    const int corners = random.integer(3, 9);
    const double size = trial % 2 ? 1 : random.log_uniform(1e-9, 1e9);
    const std::vector<Vec3> polygon = random_polygon(random, corners, size);
    const Vec3 n = random.unit_vector();
    const double offset = n.dot(polygon[0]) + size * random.uniform(-1, 1);
    const std::vector<Vec3> left = clip(polygon, n, offset), rest = clip(polygon, -n, -offset);
    given() = "given a polygon of " + std::to_string(corners) + " corners, about " + show(size) +
              " m in radius, and n = " + show(n) + ", offset " + show(offset);
    cut += !left.empty() && !rest.empty();
    double outside = 0;
    for (const Vec3& corner : left) outside = std::max(outside, n.dot(corner) - offset);
    expect_near("distance that the clipped polygon reaches beyond the plane [m]", "Eq. (8.8)", outside, 0,
                roundings(32, 4 * size), {},
                "The point where a side is cut has n·x = offset, and a corner stays only where n·x <= offset.");
    const double whole = area(polygon).norm();
    expect_near("area left, and that left by the opposite plane, over the whole", "Eq. (8.8)",
                (area(left).norm() + area(rest).norm()) / whole, 1, roundings(4000), {},
                "With the corners in order, both parts add up to the whole.");
    // The vector area: the same direction all round.
    if (!left.empty())
      expect_near_vector("vector area of both parts together [m²]", "Eq. (8.8)", Vec3(area(left) + area(rest)),
                         area(polygon), roundings(4000 * whole), {},
                         "Corners come in the order of the polygon, and go round in the same sense.");
    if (!left.empty() && !rest.empty())
      expect_near(
          "corners of both parts, beyond those of the whole", "Eq. (8.8)",
          static_cast<double>(left.size() + rest.size()) - corners, 4, {0, "two sides are cut, for each part"},
          {{2,
            "A point is missing where the polygon is cut. Two sides are cut, and one may be the side from the "
            "last corner to the first."},
           {3,
            "A point is missing where the polygon is cut. Two sides are cut, and one may be the side from the "
            "last corner to the first."}});
  }
  expect_at_least("polygons, of 500, that were cut in two", "Eq. (8.8)", cut, 100, "more than a half are");
}

EXERCISE_TEST(Clip, TakesAnyNumberOfCorners) {
  Random random;
  for (const int corners : {20, 300}) {
    const std::vector<Vec3> polygon = random_polygon(random, corners, 1);
    Vec3 middle = Vec3::Zero();
    for (const Vec3& corner : polygon) middle += corner / corners;
    const Vec3 n = random.unit_vector();
    const std::vector<Vec3> left = clip(polygon, n, n.dot(middle)), rest = clip(polygon, -n, -n.dot(middle));
    const std::string of = " of a polygon of " + std::to_string(corners) + " corners, cut through its middle";
    const std::string clue = "Clip all corners, for any number of them.";
    expect_near("corners of both parts" + of + ", beyond those of the whole", "Eq. (8.8)",
                static_cast<double>(left.size() + rest.size()) - corners, 4,
                {0, "two sides are cut, for each part"}, {}, clue);
    expect_near("area of both parts" + of + ", over the whole", "Eq. (8.8)",
                (area(left).norm() + area(rest).norm()) / area(polygon).norm(), 1, roundings(4000), {}, clue);
  }
}

EXERCISE_TEST(Clip, DropsNothingSmall) {
  for (const double part : relative_scales) {
    const std::vector<Vec3> corners{Vec3(-1, 0, 0), Vec3(part, 0, 0), Vec3(part, 1, 0), Vec3(-1, 1, 0)};
    const std::vector<Vec3> left = clip(corners, Vec3::UnitX(), 0);
    double highest = -1;
    for (const Vec3& p : left) highest = std::max(highest, p.x());
    expect_near("corners of a square that is " + show(part) + " m over the plane", "Eq. (8.8)",
                static_cast<double>(left.size()), 4, {0, "a count"}, {}, small_is_dropped);
    expect_near("the highest corner that is left [m]", "Eq. (8.8)", highest, 0, roundings(2),
                {{part, "A corner over the plane has stayed, as if it were on it. " + small_is_dropped}},
                small_is_dropped);
    if (::testing::Test::HasFailure()) return;
  }
}

}  // namespace
