// The contact of two edges that cross.
#include <numbers>

#include "relative_scales.hpp"
#include "shapes.hpp"

using namespace spook;
using namespace spook::testing;

namespace {

EXERCISE(EdgeContact, "8.7 edge_contact");

/// Two cubes whose ridges cross: that of i is along x, that of j, on it, along y.
struct Ridges {
  Box i, j;
  SeparatingAxis axis;  ///< n along z
  Vec3 p;               ///< between the two ridges
};

constexpr double depth = 0.02;

Ridges ridges(const Vec3& at = Vec3(1, -1, 2)) {
  const double ridge = std::sqrt(0.5);
  const Box cube{.body = 4, .x = at, .axes = Mat3::Identity(), .half_sides = Vec3::Constant(0.5)};
  Ridges both{.i = turned(cube, std::numbers::pi / 4, Vec3::UnitX()),
              .j = turned(cube, std::numbers::pi / 4, Vec3::UnitY()),
              .axis = {.n = Vec3::UnitZ(), .gap = -depth, .edge_i = 0, .edge_j = 1},
              .p = at + Vec3(0.1, 0, ridge - depth / 2)};
  both.j.body = 9;
  both.j.x += Vec3(0.1, -0.2, 2 * ridge - depth);
  return both;
}

std::string describe_ridges(const Ridges& both) {
  return describe_both(both.i, both.j) + "\nand the axis n = " + show(both.axis.n) +
         ", edge_i = " + std::to_string(both.axis.edge_i) + ", edge_j = " + std::to_string(both.axis.edge_j);
}

EXERCISE_TEST(EdgeContact, IsWhereTwoRidgesCross) {
  const Ridges both = ridges();
  given() = describe_ridges(both);
  const Contact got = edge_contact(both.i, both.j, both.axis);
  const Vec3 n = both.axis.n;
  expect_contact(
      "two ridges that cross", "Eq. (8.3), (8.9)", got,
      {.i = 4, .j = 9, .n = n, .gap = -depth, .p = both.p, .x_i = both.i.x, .x_j = both.j.x},
      {{depth, "The gap is that of the axis: negative where boxes overlap."},
       {-depth / 2, "Half the gap is for the point p. The gap itself is not halved."}},
      {{Vec3(both.p - depth / 2 * n), "This is on the edge of j. p is in the middle between both edges."},
       {Vec3(both.p + depth / 2 * n), "This is on the edge of i. p is in the middle between both edges."},
       {Vec3(both.p - both.j.x + both.i.x), "r_i is from the centre of i, r_j from that of j."}});
}

EXERCISE_TEST(EdgeContact, FindsTheCrossingToTheLastDigits) {
  // Both are shifted, and the one above is turned, by little.
  const double ridge = std::sqrt(0.5);
  for (const double part : relative_scales) {
    Ridges both = ridges(Vec3::Zero());
    both.j = turned(both.j, part, Vec3::UnitZ());
    both.i.x.y() = part;
    both.j.x.x() = part;
    given() = describe_ridges(both);
    const Contact got = edge_contact(both.i, both.j, both.axis);
    const Vec3 p(part - (part + 0.2) * std::tan(part), part, ridge - depth / 2);
    const Tolerance close = roundings(64, 2);
    expect_near_vector("x_i + r_i where two ridges cross [m]", "Eq. (8.3), (8.9)", Vec3(both.i.x + got.r_i), p,
                       close, {}, small_is_dropped);
    expect_near_vector("x_j + r_j where two ridges cross [m]", "Eq. (8.3), (8.9)", Vec3(both.j.x + got.r_j), p,
                       close, {}, small_is_dropped);
    if (::testing::Test::HasFailure()) return;
  }
}

/// Returns the edge of a box along axis k that is farthest along `out`: its middle.
Vec3 farthest_edge(const Box& box, int k, const Vec3& out) {
  Vec3 middle = box.x;
  double most = -infinity;
  for (const double one : {-1.0, 1.0})
    for (const double other : {-1.0, 1.0}) {
      const int a = (k + 1) % 3, b = (k + 2) % 3;
      const Vec3 x =
          box.x + one * box.half_sides[a] * box.axes.col(a) + other * box.half_sides[b] * box.axes.col(b);
      if (out.dot(x) > most) most = out.dot(x), middle = x;
    }
  return middle;
}

double distance_from_line(const Vec3& p, const Vec3& on_line, const Vec3& along) {
  return (p - on_line).cross(along).norm();
}

EXERCISE_TEST(EdgeContact, IsBetweenTheNearestPointsOfBothEdges) {
  Random random;
  for (int trial = 0; trial < 300 && !::testing::Test::HasFailure(); ++trial) {
    const Box i = random_box(random, 3);
    Box j = random_box(random, 1);
    const int a = random.integer(0, 2), b = random.integer(0, 2);
    Vec3 n = i.axes.col(a).cross(j.axes.col(b));
    const double sine = n.norm();
    if (sine < 0.05) continue;
    n = (random.integer(0, 1) ? n : -n) / sine;
    const double overlap = random.uniform(0, 0.1);
    const Vec3 e_i = i.axes.col(a), e_j = j.axes.col(b);
    j.x += n.dot(farthest_edge(i, a, n) - farthest_edge(j, b, -n)) * n - overlap * n;
    const SeparatingAxis axis{.n = n, .gap = -overlap, .edge_i = a, .edge_j = b};
    given() = describe_ridges(Ridges{.i = i, .j = j, .axis = axis, .p = {}});
    const Contact got = edge_contact(i, j, axis);
    const Vec3 p = i.x + got.r_i, on_i = p + overlap / 2 * n, on_j = p - overlap / 2 * n;
    const Tolerance close = roundings(256 / sine / sine, 8);
    expect_near("distance of p - gap/2 n from the edge of i that is farthest along n, as a straight line [m]",
                "Eq. (8.9)", distance_from_line(on_i, farthest_edge(i, a, n), e_i), 0, close, {},
                "Of four edges of i along axes.col(edge_i) it is the one farthest along n. s is along it.");
    expect_near("distance of p + gap/2 n from the edge of j that is farthest along -n, as a straight line [m]",
                "Eq. (8.9)", distance_from_line(on_j, farthest_edge(j, b, -n), e_j), 0, close, {},
                "Of four edges of j along axes.col(edge_j) it is the one farthest along -n. t is along it.");
    expect_true("i = " + std::to_string(got.i) + ", j = " + std::to_string(got.j) + ", n and gap of the axis",
                "Eq. (8.7)", got.i == 3 && got.j == 1 && got.n == n && got.gap == -overlap,
                "Bodies are those of the arguments, in their order, whichever number is lower.");
    if (::testing::Test::HasFailure() || !expect_common_point(got, i.x, j.x)) return;
  }
}

EXERCISE_TEST(EdgeContact, IsTheSameWhicheverBoxIsFirst) {
  const Ridges both = ridges();
  const SeparatingAxis back{.n = -both.axis.n, .gap = -depth, .edge_i = 1, .edge_j = 0};
  given() = describe_ridges(Ridges{.i = both.j, .j = both.i, .axis = back, .p = {}});
  const Contact one = edge_contact(both.i, both.j, both.axis), other = edge_contact(both.j, both.i, back);
  expect_near_vector("r_j, with both boxes exchanged, beside r_i without [m]", "Eq. (8.9)", other.r_j, one.r_i,
                     roundings(64, 4), {}, "The middle between two points does not depend on their order.");
  expect_near_vector("r_i, with both boxes exchanged, beside r_j without [m]", "Eq. (8.9)", other.r_i, one.r_j,
                     roundings(64, 4), {}, "The middle between two points does not depend on their order.");
}

EXERCISE_TEST(EdgeContact, IsTheSameFarFromTheOrigin) {
  const Vec3 far(1048576, -2097152, 524288);
  Ridges there = ridges();
  there.i.x += far;
  there.j.x += far;
  // Other half sides than those of j: otherwise the roundings of both corners would cancel in the middle.
  there.i.half_sides.y() = 0.4;
  // Adding `far` rounds the places, but their difference is exact: near the origin it is the same.
  Ridges near = there;
  near.j.x -= near.i.x;
  near.i.x.setZero();
  given() = describe_ridges(there);
  const Contact got = edge_contact(there.i, there.j, there.axis),
                want = edge_contact(near.i, near.j, near.axis);
  const std::string clue =
      "Use positions relative to the centre of one box. Far from the origin x_j - x_i is exact, but p - x has "
      "few digits.";
  expect_near_vector("r_i, 2000 km away [m]", "Eq. (8.9)", got.r_i, want.r_i, {1e-13, "roundings"}, {}, clue);
  expect_near_vector("r_j, 2000 km away [m]", "Eq. (8.9)", got.r_j, want.r_j, {1e-13, "roundings"}, {}, clue);
}

}  // namespace
