// Clipping of polygons, and the choice of four contacts.
#include <algorithm>
#include <numbers>
#include <numeric>

#include "relative_scales.hpp"
#include "shapes.hpp"

using namespace spook;
using namespace spook::testing;

namespace {

EXERCISE(Clip, "8.6 clip");
EXERCISE(WellSpread, "8.7 well_spread");

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

Contact at(const Vec3& r, double gap, const Vec3& n = Vec3::UnitZ()) {
  return {.i = 3, .j = 5, .n = n, .gap = gap, .r_i = r, .r_j = r - Vec3(0.7, -0.4, 2)};
}

bool same(const Contact& a, const Contact& b) {
  return a.i == b.i && a.j == b.j && a.gap == b.gap && a.n == b.n && a.r_i == b.r_i && a.r_j == b.r_j;
}

/// Expects some of the given contacts, each at most once.
bool expect_some_of(const std::vector<Contact>& kept, const std::vector<Contact>& given_contacts,
                    std::size_t count) {
  expect_near("contacts kept of " + std::to_string(given_contacts.size()), "Eq. (8.10)",
              static_cast<double>(kept.size()), static_cast<double>(count), {0, "a count"},
              {{0,
                "No contact is kept. If the mean is on a point, or on a line between two, a term is zero up to "
                "round-off and may be negative. Allow for this."}},
              "Four of more than four; four or fewer stay as they are.");
  if (::testing::Test::HasFailure()) return false;
  std::vector<bool> taken(given_contacts.size(), false);
  for (const Contact& contact : kept) {
    std::size_t found = 0;
    while (found < given_contacts.size() && (taken[found] || !same(contact, given_contacts[found]))) ++found;
    expect_true("a contact kept, with r_i = " + show(contact.r_i) + " and gap " + show(contact.gap) +
                    ", is one of those given, and kept once",
                "Eq. (8.10)", found < given_contacts.size(),
                "Do not change a contact, and do not keep it twice.");
    if (::testing::Test::HasFailure()) return false;
    taken[found] = true;
  }
  return true;
}

EXERCISE_TEST(WellSpread, LeavesFourAsTheyAre) {
  std::vector<Contact> contacts;
  for (int count = 0; count <= 4; ++count) {
    if (!expect_some_of(well_spread(contacts), contacts, static_cast<std::size_t>(count))) return;
    contacts.push_back(at(Vec3(count % 2, count / 2, 0), -0.1 * count));
  }
  // Four in one corner, as near to each other as numbers are: whether the mean is within is roundings, and not asked.
  Random random;
  for (int trial = 0; trial < 200; ++trial) {
    contacts.clear();
    while (contacts.size() < 4) contacts.push_back(at(Vec3(0.5, 0.3, 0.1) + random.vector(2e-16), -0.01));
    if (!expect_some_of(well_spread(contacts), contacts, 4)) return;
  }
}

/// Differences of gaps within which any contact counts as the deepest, in distances from the mean, and round-off.
constexpr double as_deep = 0.003 * (1 + 1e-9);

double deepest_of(const std::vector<Contact>& contacts) {
  double gap = infinity;
  for (const Contact& contact : contacts) gap = std::min(gap, contact.gap);
  return gap;
}

/// Places around the normal, as seen along it.
std::vector<Eigen::Vector2d> seen_along_n(const std::vector<Contact>& contacts, const Vec3& mean) {
  const auto [t1, t2] = tangents(contacts[0].n);
  std::vector<Eigen::Vector2d> places;
  for (const Contact& contact : contacts)
    places.emplace_back(t1.dot(contact.r_i - mean), t2.dot(contact.r_i - mean));
  return places;
}

/// Convex hull of points, in order (Andrew's monotone chain).
std::vector<Eigen::Vector2d> hull(std::vector<Eigen::Vector2d> points) {
  std::sort(points.begin(), points.end(),
            [](const auto& a, const auto& b) { return a.x() < b.x() || (a.x() == b.x() && a.y() < b.y()); });
  const auto left_turn = [](const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c) {
    return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
  };
  std::vector<Eigen::Vector2d> chain;
  for (int side = 0; side < 2; ++side) {
    const std::size_t start = chain.size();
    for (const auto& point : points) {
      while (chain.size() >= start + 2 && left_turn(chain[chain.size() - 2], chain.back(), point) <= 0)
        chain.pop_back();
      chain.push_back(point);
    }
    chain.pop_back();
    std::reverse(points.begin(), points.end());
  }
  return chain;
}

double hull_area(const std::vector<Eigen::Vector2d>& points) {
  const auto around = hull(points);
  double twice = 0;
  for (std::size_t k = 0; k < around.size(); ++k) {
    const auto &a = around[k], &b = around[(k + 1) % around.size()];
    twice += a.x() * b.y() - a.y() * b.x();
  }
  return twice / 2;
}

/// Returns the depth of the origin within the hull of points [m]; negative outside.
double depth_of_origin(const std::vector<Eigen::Vector2d>& points) {
  const auto around = hull(points);
  double depth = infinity;
  for (std::size_t k = 0; k < around.size(); ++k) {
    const auto &a = around[k], &b = around[(k + 1) % around.size()];
    depth = std::min(depth, (a.x() * b.y() - a.y() * b.x()) / (b - a).norm());
  }
  return depth;
}

/// Eq. (8.10) for four points around the origin. Where one is within the other three it is less than their hull.
double area_around_the_origin(std::vector<Eigen::Vector2d> four) {
  std::sort(four.begin(), four.end(),
            [](const auto& a, const auto& b) { return std::atan2(a.y(), a.x()) < std::atan2(b.y(), b.x()); });
  double twice = 0;
  for (std::size_t k = 0; k < 4; ++k)
    twice += four[k].x() * four[(k + 1) % 4].y() - four[k].y() * four[(k + 1) % 4].x();
  return twice / 2;
}

/// The largest area of four with the deepest and the mean, by trying all.
double largest_area(const std::vector<Eigen::Vector2d>& points, std::size_t deepest) {
  double largest = 0;
  const std::size_t n = points.size();
  for (std::size_t a = 0; a < n; ++a)
    for (std::size_t b = a + 1; b < n; ++b)
      for (std::size_t c = b + 1; c < n; ++c) {
        if (a == deepest || b == deepest || c == deepest) continue;
        const std::vector<Eigen::Vector2d> four = {points[deepest], points[a], points[b], points[c]};
        const double found = area_around_the_origin(four);
        if (found > largest && depth_of_origin(four) >= 0) largest = found;
      }
  return largest;
}

void expect_well_spread(const std::vector<Contact>& contacts, const std::string& what) {
  const std::vector<Contact> kept = well_spread(contacts);
  given() = "given " + what + ", r_i and gap:";
  for (const Contact& contact : contacts) given() += "\n  " + show(contact.r_i) + "  " + show(contact.gap);
  if (!expect_some_of(kept, contacts, 4)) return;
  Vec3 mean = Vec3::Zero();
  for (const Contact& contact : contacts) mean += contact.r_i / static_cast<double>(contacts.size());
  const auto all = seen_along_n(contacts, mean), four = seen_along_n(kept, mean);
  double extent = 0;
  for (const auto& place : all) extent = std::max(extent, place.norm());

  expect_at_most("gap of the deepest that is kept, of " + what + " [m]", "Eq. (8.10)", deepest_of(kept),
                 deepest_of(contacts) + as_deep * extent,
                 "that of the deepest of all, and 0.003 of the distances",
                 "The deepest contact describes the overlap best, so it is always kept, wherever it is in the "
                 "list.");
  if (::testing::Test::HasFailure()) return;
  expect_at_least(
      "how far the mean of all points is within the four, of " + what + " [m]", "Eq. (8.10)",
      depth_of_origin(four), -1e-9 * extent, "within, to roundings",
      "A body with its centre over the mean would tip over these four. If two neighbours are more than half a "
      "turn apart, as seen from the mean, the mean is outside.");
  if (::testing::Test::HasFailure()) return;
  // Which of those that are as deep is kept is open: half of the largest area with the one that allows the least.
  double largest = infinity;
  for (std::size_t k = 0; k < contacts.size(); ++k)
    if (contacts[k].gap <= deepest_of(contacts) + as_deep * extent)
      largest = std::min(largest, largest_area(all, k));
  expect_at_least("area that the four span, of " + what + " [m²]", "Eq. (8.10)", hull_area(four),
                  0.5 * largest - 1e-5 * extent * extent,
                  "half of the largest by Eq. (8.10), with the deepest and the mean",
                  "Points close together support no more than a single one. Take points far from each other.");
}

EXERCISE_TEST(WellSpread, TakesTheCornersOfASquare) {
  // Four corners and the middles of the sides, the deepest a corner; then more points than there is use for, at one
  // side.
  for (const double size : {1.0, 1e-6}) {
    std::vector<Contact> contacts;
    for (int k = 0; k < 8; ++k) {
      const double angle = std::numbers::pi / 4 * k, reach = k % 2 ? std::sqrt(2.0) : 1;
      contacts.push_back(
          at(size * reach * Vec3(std::cos(angle), std::sin(angle), 0), size * (k == 3 ? -0.02 : -0.01)));
    }
    expect_well_spread(contacts, "a square's corners and middles");
    for (int k = 0; k < 6; ++k)
      contacts.insert(contacts.begin(), at(size * Vec3(1 + 0.01 * k, 0.3 - 0.001 * k, 0), -0.01 * size));
    expect_well_spread(contacts, "a square's corners and middles, and a crowd at one side");
    if (::testing::Test::HasFailure()) return;
  }
}

/// Places across n, in units of about the largest distance from the middle.
std::vector<Eigen::Vector2d> random_places(Random& random, int count) {
  // Anywhere; on a circle; all but four in one direction; four corners, and all others at one of them.
  const int kind = random.integer(0, 3);
  const auto towards = [](double angle, double reach) {
    return Eigen::Vector2d(reach * std::cos(angle), reach * std::sin(angle));
  };
  std::vector<Eigen::Vector2d> places;
  const int crowded = random.integer(0, 3);
  for (int k = 0; k < 4; ++k) {
    const double turn = kind == 3 ? std::numbers::pi / 2 * (k + random.uniform(-0.3, 0.3))
                                  : random.uniform(0, 2 * std::numbers::pi);
    places.push_back(towards(turn, kind == 1 ? 1 : random.uniform(0.1, 1)));
  }
  while (static_cast<int>(places.size()) < count)
    if (kind == 3)
      places.push_back(places[static_cast<std::size_t>(crowded)] +
                       towards(random.uniform(0, 2 * std::numbers::pi), 1e-3));
    else {
      const double turn = random.uniform(0, kind == 2 ? 0.5 : 2 * std::numbers::pi);
      places.push_back(towards(turn, kind == 1 ? 1 : random.uniform(0, 1)));
    }
  // The order of the input does not matter.
  for (int k = count - 1; k > 0; --k)
    std::swap(places[static_cast<std::size_t>(k)], places[static_cast<std::size_t>(random.integer(0, k))]);
  return places;
}

/// Returns whether four are kept, the deepest among them, and the mean is inside; reports no failure.
bool is_sound(const std::vector<Contact>& contacts) {
  const std::vector<Contact> kept = well_spread(contacts);
  if (kept.size() != 4) return false;
  for (std::size_t k = 0; k < 4; ++k)
    for (std::size_t l = 0; l < k; ++l)
      if (same(kept[k], kept[l])) return false;
  Vec3 mean = Vec3::Zero();
  for (const Contact& contact : contacts) mean += contact.r_i / static_cast<double>(contacts.size());
  return deepest_of(kept) <= deepest_of(contacts) + 10 * as_deep &&
         depth_of_origin(seen_along_n(kept, mean)) >= -4e-9;
}

// The same places in the plane across z, across x, upside down, and turned: what is right along z is right along any n.
EXERCISE_TEST(WellSpread, LooksAlongNWhereverItPoints) {
  Random random;
  std::vector<std::vector<Contact>> all;
  for (int trial = 0; trial < 50; ++trial) {
    std::vector<Contact> contacts;
    for (const Eigen::Vector2d& place : random_places(random, 5)) {
      const double gap = random.uniform(-0.1, -0.01);
      contacts.push_back(at(Vec3(place.x(), place.y(), 0), gap));
    }
    if (!is_sound(contacts)) return;  // then it is not about n, and other tests say what it is
    all.push_back(contacts);
  }
  const Mat3 turned = random.rotation().toRotationMatrix();
  const Mat3 to_x = (Mat3() << 0, 0, 1, 1, 0, 0, 0, 1, 0).finished();
  const Mat3 upside_down = Vec3(1, -1, -1).asDiagonal();
  for (const Mat3& R : {to_x, upside_down, turned})
    for (std::vector<Contact> contacts : all) {
      for (Contact& contact : contacts) contact = at(R * contact.r_i, contact.gap, R.col(2));
      if (is_sound(contacts)) continue;
      this_failure_explains();
      expect_true("four of five that were well chosen with n = (0, 0, 1) are so with n = " +
                      show(Vec3(R.col(2))) + ", all points turned along",
                  "Eq. (8.10)", false,
                  "This takes n for z. Angles and areas are those in the plane across n, and contacts lie in "
                  "any plane.");
      return;
    }
}

EXERCISE_TEST(WellSpread, KeepsTheDeepestAndHoldsTheMean) {
  Random random;
  for (int trial = 0; trial < 600 && !::testing::Test::HasFailure(); ++trial) {
    // Along the axes of the world, too, where two of three coordinates are all that differs.
    const Vec3 n = trial % 3 ? random.unit_vector() : Vec3((trial % 2 ? 1 : -1) * Vec3::Unit(trial / 3 % 3));
    const auto [t1, t2] = tangents(n);
    const double size = random.log_uniform(1e-9, 1e3);
    const int count = random.integer(5, random.integer(0, 1) ? 12 : 6);
    // A hundredth as wide as long, as the edge of a board is: what is small beside a square is not beside this.
    const double width = random.integer(0, 1) ? 0.7 : 0.007;
    // As deep to a ten-thousandth: then any of them may count as the deepest.
    const bool alike = random.integer(0, 1);
    std::vector<Contact> contacts;
    for (const Eigen::Vector2d& place : random_places(random, count)) {
      const Vec3 r = size * (Vec3(5, -3, 2) + place.x() * t1 + width * place.y() * t2);
      // At least one is deep. What is nearly touching is the least deep of all: by its gap, not by how large that is.
      const double gap =
          alike ? -0.01 + random.uniform(-1e-4, 1e-4) : random.uniform(-0.1, contacts.empty() ? -0.01 : 0.15);
      contacts.push_back(at(r, size * gap, n));
    }
    expect_well_spread(contacts, std::to_string(count) + " random contacts");
  }
}

EXERCISE_TEST(WellSpread, TakesAnyNumber) {
  Random random;
  for (int trial = 0; trial < 4 && !::testing::Test::HasFailure(); ++trial) {
    std::vector<Contact> contacts;
    for (const Eigen::Vector2d& place : random_places(random, 30))
      contacts.push_back(at(Vec3(place.x(), place.y(), 0), random.uniform(-0.1, -0.01)));
    contacts.back().gap = -0.2;
    expect_well_spread(contacts, "30 random contacts, the last the deepest");
  }
  // Seventy beside each other and then four corners, of which the last has ten at it. Around the mean, in the middle,
  // come the deepest, the crowd, and the other corners. Without the second corner the others span less than half, and
  // without the last the mean is outside.
  const Vec3 middle(5, -3, 2), corners[] = {Vec3(-1, 0, 0), Vec3(0, -4, 0), Vec3(3, -0.5, 0), Vec3(0, 1, 0)};
  const Vec3 balance = -(corners[0] + corners[1] + corners[2] + 10 * corners[3]) / 70;
  std::vector<Contact> contacts;
  for (int k = 0; k < 70; ++k) {
    const Vec3 place = middle + balance + random.vector(1e-3);
    contacts.push_back(at(place, random.uniform(-0.1, -0.01)));
  }
  for (int k = 0; k < 10; ++k) contacts.push_back(at(middle + corners[3] + random.vector(1e-3), -0.01));
  for (int k = 2; k >= 0; --k) contacts.push_back(at(middle + corners[k], k == 0 ? -0.2 : -0.01));
  if (!::testing::Test::HasFailure())
    expect_well_spread(contacts, "a crowd of 70, and four corners at the end of the list");
  contacts.push_back(at(middle + balance, -0.3));
  if (!::testing::Test::HasFailure())
    expect_well_spread(contacts, "the same, and the deepest in the crowd, the last of the list");
}

EXERCISE_TEST(WellSpread, HoldsTheMeanToRoundings) {
  // The largest four with the deepest, at (±1, 0) and (±1, 1), have the mean 4 nm behind one of their sides. Turned any
  // way, so that no coordinate is small. The centre of the body may be anywhere: in the middle, and 20 nm from a
  // corner.
  const double outside = 4e-9;
  Random random;
  for (const Mat3& R : {Mat3(Mat3::Identity()), random.rotation().toRotationMatrix()})
    for (const auto& centre : {Eigen::Vector2d(0, 0), {-1, 2e-8}, {-1, -2e-8}, {1, 2e-8}, {1, -2e-8}}) {
      const auto turned = [&](double x, double y, double gap) {
        return at(R * Vec3(x - centre.x(), y - centre.y(), 0), gap, R.col(2));
      };
      std::vector<Contact> contacts = {turned(-1, 0, -0.02), turned(1, 0, -0.01), turned(-1, 1, -0.01),
                                       turned(1, 1, -0.01)};
      for (int k = 0; k < 8; ++k) contacts.push_back(turned(0.01 * (k - 3.5), -(2 + 12 * outside) / 8, -0.01));
      expect_well_spread(contacts, "four at the corners of a rectangle and eight beside it");
      if (::testing::Test::HasFailure()) return;
    }
}

EXERCISE_TEST(WellSpread, HoldsTheMeanWhereTheDeepestIs) {
  // Around the deepest, with the mean on it but for roundings: none of the angles from it is certain, nor any sign.
  Random random;
  for (int trial = 0; trial < 100 && !::testing::Test::HasFailure(); ++trial) {
    const Vec3 n = random.unit_vector(), middle = random.vector();
    const auto [t1, t2] = tangents(n);
    const int count = random.integer(4, 7);
    const double start = random.uniform(0, 6);
    std::vector<Contact> contacts = {at(middle, -0.02, n)};
    for (int k = 0; k < count; ++k) {
      const double angle = start + 2 * std::numbers::pi * k / count;
      contacts.push_back(at(middle + std::cos(angle) * t1 + std::sin(angle) * t2, -0.01, n));
    }
    expect_well_spread(contacts, "a ring of " + std::to_string(count) + " around the deepest");
  }
}

EXERCISE_TEST(WellSpread, AcceptsEqualDepths) {
  Random random;
  for (int trial = 0; trial < 100 && !::testing::Test::HasFailure(); ++trial) {
    std::vector<Contact> contacts;
    for (int k = 0; k < 8; ++k) {
      const double angle = std::numbers::pi / 4 * (k + 0.5);
      contacts.push_back(at(Vec3(std::cos(angle), std::sin(angle), 0), -0.001 + random.uniform(-1e-17, 1e-17)));
    }
    std::rotate(contacts.begin(), contacts.begin() + random.integer(0, 7), contacts.end());
    expect_well_spread(contacts, "an octagon's corners");
  }
}

/// The numbers of those that are kept, in order.
std::vector<int> numbers_of_those_kept(const std::vector<Contact>& contacts) {
  std::vector<int> numbers;
  for (const Contact& kept : well_spread(contacts))
    for (std::size_t k = 0; k < contacts.size(); ++k)
      if (same(kept, contacts[k])) numbers.push_back(static_cast<int>(k));
  std::sort(numbers.begin(), numbers.end());
  return numbers;
}

/// `size` is what is meant by their distances.
bool expect_the_same_while_they_tremble(Random& random, const std::vector<Contact>& still, double size,
                                        int trials = 100) {
  const auto listed = [](const std::vector<int>& numbers) {
    std::string text;
    for (const int k : numbers) text += " " + std::to_string(k);
    return text;
  };
  const std::vector<int> first = numbers_of_those_kept(still);
  for (int trial = 0; trial < trials; ++trial) {
    // Their gaps by as much as round-off, or as what boxes sag at rest.
    const double sag = trial % 2 ? 1e-3 : 1e-9;
    std::vector<Contact> moved = still;
    for (Contact& contact : moved) {
      contact.r_i += random.vector(1e-9 * size);
      contact.gap += random.uniform(-1, 1) * sag * size;
    }
    const std::vector<int> now = numbers_of_those_kept(moved);
    expect_true(
        "of the contacts 0 to " + std::to_string(still.size() - 1) + " those kept," + listed(now) +
            ", are the same as before they moved by " + show(1e-9 * size) + " m, and their gaps by " +
            show(sag * size) + " m," + listed(first),
        "Eq. (8.10)", now == first,
        "Round-off or sag has chosen, so a box would tremble. The deepest may be any whose gap is larger than "
        "the least by at most 0.003 of the distances. Let another four win only if its area is larger by a "
        "millionth of their squares.");
    if (::testing::Test::HasFailure()) return false;
  }
  return true;
}

EXERCISE_TEST(WellSpread, KeepsItsChoiceUnderSmallChanges) {
  // Eight that are as deep, on a circle or a square; or of which the deepest has as good a four on either side. And one
  // in the middle, not as deep, from which it cannot be told how far they are from each other.
  Random random;
  for (const double size : {1.0, 1e-6, 1e3})
    for (int direction = 0; direction < 3; ++direction)
      for (const bool cornered : {false, true})
        for (const bool middle : {false, true}) {
          // A face of a box that stands straight: across its normal two coordinates are all that differs.
          const Vec3 n = Vec3::Unit(direction), t1 = Vec3::Unit((direction + 1) % 3), t2 = n.cross(t1);
          std::vector<Contact> contacts;
          for (int k = 0; k < 8; ++k) {
            const double angle = std::numbers::pi / 4 * k, reach = cornered && k % 2 ? std::sqrt(2.0) : 1;
            contacts.push_back(at(size * reach * (std::cos(angle) * t1 + std::sin(angle) * t2),
                                  size * (middle && k == 2 ? -0.02 : -0.01), n));
          }
          contacts.push_back(at(Vec3::Zero(), -0.001 * size, n));
          given() =
              "given the middle and " +
              (cornered ? "the corners and the middles of a square with sides of " + show(2 * size) + " m, "
                        : "the corners of a regular octagon with a radius of " + show(size) + " m, ") +
              (middle ? "one the deepest" : "all as deep") + ", across " + show(n);
          if (!expect_the_same_while_they_tremble(random, contacts, size)) return;
        }
  std::vector<Contact> crowded(70, at(Vec3::Zero(), -0.001));
  for (int k = 0; k < 8; ++k) {
    const double angle = std::numbers::pi / 4 * k;
    crowded.push_back(at(Vec3(std::cos(angle), std::sin(angle), 0), -0.01));
  }
  given() =
      "given 70 in the middle, and then the corners of a regular octagon with a radius of 1 m, all as deep";
  expect_the_same_while_they_tremble(random, crowded, 1, 10);
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
