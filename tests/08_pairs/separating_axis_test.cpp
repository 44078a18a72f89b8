// The axis along which two boxes are least deep in each other.
#include <algorithm>
#include <array>
#include <numbers>

#include "relative_scales.hpp"
#include "shapes.hpp"

using namespace spook;
using namespace spook::testing;

namespace {

EXERCISE(SeparatingAxis, "8.5 separating_axis");

double half_width(const Box& box, const Vec3& n) {
  double sum = 0;
  for (int k = 0; k < 3; ++k) sum += box.half_sides[k] * std::abs(n.dot(box.axes.col(k)));
  return sum;
}

double gap_along(const Box& i, const Box& j, const Vec3& n) {
  return std::abs(n.dot(j.x - i.x)) - half_width(i, n) - half_width(j, n);
}

struct Candidate {
  Vec3 n;
  double gap;
  int kind;  // 0: a face of i, 1: a face of j, 2: edges
};

std::vector<Candidate> all_axes(const Box& i, const Box& j) {
  std::vector<Candidate> all;
  for (int k = 0; k < 3; ++k) all.push_back({i.axes.col(k), gap_along(i, j, i.axes.col(k)), 0});
  for (int k = 0; k < 3; ++k) all.push_back({j.axes.col(k), gap_along(i, j, j.axes.col(k)), 1});
  for (int a = 0; a < 3; ++a)
    for (int b = 0; b < 3; ++b) {
      const Vec3 across = i.axes.col(a).cross(j.axes.col(b));
      if (across.norm() > 1e-6) all.push_back({across.normalized(), gap_along(i, j, across.normalized()), 2});
    }
  return all;
}

double best_of(const std::vector<Candidate>& all, int kind) {
  double best = -infinity;
  for (const Candidate& one : all)
    if (one.kind == kind) best = std::max(best, one.gap);
  return best;
}

double smallest(const Box& i, const Box& j) {
  return std::min(i.half_sides.minCoeff(), j.half_sides.minCoeff());
}

/// By how much an axis has to be better than another to take its place.
double margin(double gap, const Box& i, const Box& j) {
  return 0.05 * std::abs(gap) + 1e-3 * smallest(i, j);
}

/// Two choices by a margin, and one among the faces of a box: the axis may be behind the best by three of them.
void expect_best(const spook::SeparatingAxis& got, const Box& i, const Box& j) {
  const auto all = all_axes(i, j);
  const double faces_i = best_of(all, 0), faces_j = best_of(all, 1), edges = best_of(all, 2);
  const double faces = std::max(faces_i, faces_j), best = std::max(faces, edges);
  expect_at_least(
      "g along the axis that is chosen [m], where the best of i's faces has " + show(faces_i) + ", of j's " +
          show(faces_j) + ", of the edges " + show(edges),
      "Eq. (8.7)", got.gap,
      best - 3 * margin(best, i, j) - roundings(64, i.half_sides.norm() + j.half_sides.norm()).value,
      "the largest, less 5 per cent of it and a thousandth of the smallest half side at each choice",
      std::abs(got.gap - faces) <= 1e-12 * std::abs(faces) && edges > faces
          ? "This is the best of the faces; the axes across an edge of each are left out, or held "
            "to too large a margin."
          : "The least deep has the largest gap, the one nearest to zero. What another has to be "
            "better by is 5 per "
            "cent of the gap, and a thousandth of the smallest half side of the two boxes.");
}

/// Expects a unit vector from i to j, with the gap and the edges that belong to this axis.
bool expect_sound(const spook::SeparatingAxis& got, const Box& i, const Box& j) {
  const double size = i.half_sides.norm() + j.half_sides.norm() + (j.x - i.x).norm();
  expect_near("|n|", "Eq. (8.6)", got.n.norm(), 1, {1e-9, "edges that are nearly parallel"}, {},
              "e_a × e_b has the length of the sine of the angle between them: normalise.");
  expect_at_least("n·(x_j - x_i) [m]", "Eq. (8.6)", got.n.dot(j.x - i.x), -1e-12 * size, "0, and roundings",
                  "n points from i to j: turn it around where it doesn't.");
  const double want = gap_along(i, j, got.n);
  const double apart = std::abs(got.n.dot(j.x - i.x));
  const auto is_axis = [](int k) { return k >= 0 && k < 3; };
  const double sine = is_axis(got.edge_i) && is_axis(got.edge_j)
                          ? i.axes.col(got.edge_i).cross(j.axes.col(got.edge_j)).norm()
                          : 1;
  expect_near(
      "g(n) [m]", "Eq. (8.6)", got.gap, want, {1e-12 * size, "roundings"},
      {{sine * want, "This is along e_a × e_b, which is no unit vector: divide the gap by its length, too."},
       {-want, "This is a depth: the gap is negative where they overlap."},
       {apart, "The half widths ρ are missing."},
       {apart - half_width(i, got.n), "ρ_j is missing."},
       {apart - half_width(j, got.n), "ρ_i is missing."}},
      "|n·(x_j - x_i)| less both half widths, Σ h_k |n·e_k|.");
  if (::testing::Test::HasFailure()) return false;

  const bool of_i = got.face_i >= 0, of_j = got.face_j >= 0, of_edges = got.edge_i >= 0 && got.edge_j >= 0;
  expect_true("face_i " + std::to_string(got.face_i) + ", face_j " + std::to_string(got.face_j) + ", edge_i " +
                  std::to_string(got.edge_i) + ", edge_j " + std::to_string(got.edge_j) +
                  ": set one face, or an edge of each box; all others are -1",
              "Eq. (8.7)",
              of_i + of_j + of_edges == 1 && (of_edges || (got.edge_i == -1 && got.edge_j == -1)) &&
                  std::max({got.face_i, got.face_j, got.edge_i, got.edge_j}) <= 2,
              "box_box needs to know which axis it was.");
  if (::testing::Test::HasFailure()) return false;
  double off = 0;
  if (of_i) off = got.n.cross(i.axes.col(got.face_i)).norm();
  if (of_j) off = got.n.cross(j.axes.col(got.face_j)).norm();
  if (of_edges) off = std::abs(got.n.dot(i.axes.col(got.edge_i))) + std::abs(got.n.dot(j.axes.col(got.edge_j)));
  expect_near(of_edges ? "n along its two edges" : "n across its face's axis", "Eq. (8.7)", off, 0,
              {1e-9, "edges that are nearly parallel"}, {},
              of_edges ? "The axis of two edges is e_a × e_b, across both."
                       : "face_i and face_j say along which axis of the box n is.");
  return !::testing::Test::HasFailure();
}

EXERCISE_TEST(SeparatingAxis, FindsTheFacesOfStraightBoxes) {
  const Box i{.body = 0, .x = Vec3(1, 1, 1), .axes = Mat3::Identity(), .half_sides = Vec3(1, 2, 3)};
  for (int k = 0; k < 3; ++k)
    for (const double side : {-1.0, 1.0}) {
      Box j{.body = 1, .x = i.x, .axes = Mat3::Identity(), .half_sides = Vec3(0.5, 0.5, 0.5)};
      j.x[k] += side * (i.half_sides[k] + 0.5 - 0.1);
      given() = describe_both(i, j);
      const auto got = separating_axis(i, j);
      if (!expect_sound(got, i, j)) return;
      expect_near_vector("n", "Eq. (8.6)", got.n, Vec3(side * Vec3::Unit(k)), roundings(16),
                         {{Vec3(-side * Vec3::Unit(k)), "n points from i to j."}},
                         "They overlap by 0.1 m along this axis, and by more along the others.");
      expect_near("g [m]", "Eq. (8.6)", got.gap, -0.1, roundings(64, 4),
                  {{0.1, "This is a depth: the gap is negative where they overlap."},
                   {3.4 - 0.5, "h_k are halves of the sides."}},
                  "The least deep of all axes is that with the largest gap.");
      if (::testing::Test::HasFailure()) return;
      expect_true(
          "its face is one of i, axis " + std::to_string(k), "Eq. (8.7)", got.face_i == k,
          got.edge_i >= 0
              ? "These are edges, whose n is along the same line. Their gap is that of the faces "
                "and no larger, unless n·(x_j - x_i) has been taken with its sign: take the "
                "absolute value. Or the margin of 5 per cent has: it is of |gap|, and of a gap below 0 it "
                "would help the edges."
              : "Both have a face there. Where they are alike, i's is taken.");
    }
}

EXERCISE_TEST(SeparatingAxis, MeetsEdgesThatCross) {
  // Two cubes on an edge each, at right angles: a roof on a ridge.
  const double half = 0.5, ridge = half * std::sqrt(2.0), depth = 0.02;
  const Box cube{.body = 0, .x = Vec3::Zero(), .axes = Mat3::Identity(), .half_sides = Vec3::Constant(half)};
  const Box i = turned(cube, std::numbers::pi / 4, Vec3::UnitX());
  Box j = turned(cube, std::numbers::pi / 4, Vec3::UnitY());
  j.body = 1;
  j.x = Vec3(0.1, -0.2, 2 * ridge - depth);
  given() = describe_both(i, j);
  const auto got = separating_axis(i, j);
  if (!expect_sound(got, i, j)) return;
  expect_near("g of two ridges that cross [m]", "Eq. (8.6), (8.7)", got.gap, -depth, roundings(64, 4),
              {{std::max(best_of(all_axes(i, j), 0), best_of(all_axes(i, j), 1)),
                "This is the best of the faces. Nine more axes are across an edge of each."}});
  if (::testing::Test::HasFailure()) return;
  expect_true("edges " + std::to_string(got.edge_i) + " of i and " + std::to_string(got.edge_j) + " of j",
              "Eq. (8.7)", got.edge_i == 0 && got.edge_j == 1, "The ridges are i's x axis and j's y axis.");
}

EXERCISE_TEST(SeparatingAxis, IsTheBestOfFifteen) {
  Random random;
  int kinds[3] = {0, 0, 0};
  for (int trial = 0; trial < 5000 && !::testing::Test::HasFailure(); ++trial) {
    const Box i = random_box(random, 0), j = random_box(random, 1);
    const auto got = separating_axis(i, j);
    const auto all = all_axes(i, j);
    const double faces_i = best_of(all, 0), faces_j = best_of(all, 1), edges = best_of(all, 2);
    const double best = std::max({faces_i, faces_j, edges});
    given() = describe_both(i, j);
    if (best > 0) {
      expect_at_least(
          "g of boxes that are apart along some axis [m]", "Eq. (8.7)", got.gap, 1e-300, "positive",
          "One axis with a positive gap is enough: nothing overlaps along it. It need not beat anything "
          "by a margin.");
      continue;
    }
    if (!expect_sound(got, i, j)) return;
    expect_best(got, i, j);
    if (::testing::Test::HasFailure()) return;
    const int kind = got.face_i >= 0 ? 0 : got.face_j >= 0 ? 1 : 2;
    ++kinds[kind];
    const double face = faces_j > faces_i + margin(faces_i, i, j) ? faces_j : faces_i;
    const double before = kind == 1 ? faces_i : face;
    if (kind > 0)
      expect_at_least(
          (kind == 1 ? "g of a face of j, where the best of i's has " : "g of edges, where the face has ") +
              show(before) + " [m]",
          "Eq. (8.7)", got.gap, before + margin(before, i, j) - 2e-6 * smallest(i, j),
          "larger by 5 per cent and a thousandth of the smallest half side",
          "Faces of i come first, then those of j, then edges: each takes the place of what was there "
          "only by a margin.");
    if (::testing::Test::HasFailure()) return;
  }
  for (int kind = 0; kind < 3; ++kind)
    expect_at_least("times, of 5000, that a face of i, a face of j, and edges were chosen", "Eq. (8.7)",
                    kinds[kind], 200, "each is often the best",
                    "All of the 15 axes are looked at: three faces of each box, nine pairs of edges.");
}

EXERCISE_TEST(SeparatingAxis, IsTheBestForAnySizes) {
  // The margins are measured by the smallest half side: a grain on a mountain, too, is met where it is least deep.
  Random random;
  int looked_at = 0;
  for (int trial = 0; trial < 2000 && !::testing::Test::HasFailure(); ++trial) {
    Box i = random_box(random, 0), j = random_box(random, 1);
    i.half_sides *= random.log_uniform(1e-6, 1e3);
    j.half_sides *= random.log_uniform(1e-6, 1e3);
    // The smaller one's centre is somewhere at an edge or a corner of the larger.
    Box& large = i.half_sides.norm() > j.half_sides.norm() ? i : j;
    Box& small = &large == &i ? j : i;
    const Vec3 corner = random.integers(-1, 1).cwiseProduct(large.half_sides);
    small.x = large.x + large.axes * corner + random.vector(0.5 * small.half_sides.minCoeff());
    const auto got = separating_axis(i, j);
    const auto all = all_axes(i, j);
    if (std::max({best_of(all, 0), best_of(all, 1), best_of(all, 2)}) > 0) continue;
    ++looked_at;
    given() = describe_both(i, j);
    if (!expect_sound(got, i, j)) return;
    expect_best(got, i, j);
  }
  expect_at_least("pairs, of 2000, that overlap", "Eq. (8.7)", looked_at, 500, "nearly all");
}

EXERCISE_TEST(SeparatingAxis, TakesTheFirstOfFacesThatAreAlike) {
  Random random;
  for (const double size : {1.0, 1e-6}) {
    const Box cube{.body = 0, .x = Vec3::Zero(), .axes = Mat3::Identity(), .half_sides = Vec3::Constant(size)};
    // In its corner: a small one, turned by 45 degrees, so that no axis of its own is better.
    const Box turned_one = turned({.body = 1,
                                   .x = size * Vec3(0.7, 0.7, 0),
                                   .axes = Mat3::Identity(),
                                   .half_sides = Vec3::Constant(0.1 * size)},
                                  std::numbers::pi / 4, Vec3::UnitZ());
    for (int trial = 0; trial < 100 && !::testing::Test::HasFailure(); ++trial) {
      Box beside = cube;
      beside.x = size * (Vec3(1.9, 1.9, trial % 2 ? 1.9 : 0) + random.vector(1e-9));
      const std::string clue =
          "Faces of one box that are alike, to a thousandth of the smallest half side: the first one stays, "
          "and roundings don't choose.";
      given() =
          "given two cubes that overlap in a corner, to a billionth of their size alike in each direction: " +
          describe(beside);
      const auto got = separating_axis(cube, beside);
      if (!expect_sound(got, cube, beside)) return;
      expect_true("face_i = " + std::to_string(got.face_i) + ": the first face of i is taken", "Eq. (8.7)",
                  got.face_i == 0, clue);
      Box corner = turned_one;
      corner.x += size * random.vector(1e-9);
      given() = "given i, a small box in the corner of a cube j, as near to one face as to another: " +
                describe(corner);
      const auto of_j = separating_axis(corner, cube);
      if (!expect_sound(of_j, corner, cube)) return;
      expect_true("face_j = " + std::to_string(of_j.face_j) + ": the first face of j is taken", "Eq. (8.7)",
                  of_j.face_j == 0, clue);
    }
  }
}

EXERCISE_TEST(SeparatingAxis, TouchingIsNotApart) {
  // A gap of exactly 0: it parts nothing, and needs its margin as any other.
  const Box cube{.body = 0, .x = Vec3::Zero(), .axes = Mat3::Identity(), .half_sides = Vec3(1, 1, 1)};
  for (const auto& [x, face] : {std::pair(Vec3(0, 0, 2), 2), std::pair(Vec3(2 - 1e-9, 2, 0), 0)}) {
    Box other = cube;
    other.body = 1;
    other.x = x;
    given() = "given two cubes of 2 m with straight sides, the second at " + show(x) + " from the first";
    const auto got = separating_axis(cube, other);
    if (!expect_sound(got, cube, other)) return;
    expect_true("face_i = " + std::to_string(got.face_i) + ": face " + std::to_string(face) + " of i is taken",
                "Eq. (8.7)", got.face_i == face,
                "Only a gap above 0 parts them. With a gap of 0 the others are alike, to a thousandth, and not "
                "better.");
    if (::testing::Test::HasFailure()) return;
  }
}

EXERCISE_TEST(SeparatingAxis, MeasuresItsMarginsByTheThinnestSide) {
  // A sheet of 2 micrometres, and a cube at its edge, less deep in its face than in its edge: by half a micrometre.
  const Box sheet{.body = 0, .x = Vec3::Zero(), .axes = Mat3::Identity(), .half_sides = Vec3(1, 1, 1e-6)};
  const Box cube{.body = 1, .x = Vec3(2 - 8e-7, 0, 1 + 7e-7), .axes = sheet.axes, .half_sides = Vec3(1, 1, 1)};
  for (const auto& [i, j] : {std::pair(sheet, cube), std::pair(cube, sheet)}) {
    const auto got = separating_axis(i, j);
    given() = describe_both(i, j);
    if (!expect_sound(got, i, j)) return;
    expect_near(
        "g [m]", "Eq. (8.7)", got.gap, -3e-7, {1e-14, "roundings of the cube's side"},
        {{-8e-7,
          "This is along x. Half a micrometre is more than a thousandth of the smallest half side of the "
          "two boxes: of the cube it would be less."}},
        "They overlap by 0.3 micrometres along z, and by more along x.");
    if (::testing::Test::HasFailure()) return;
  }
}

EXERCISE_TEST(SeparatingAxis, MeetsEdgesThatAreNearlyParallel) {
  // Two rails on their edges, one upon the other at a small angle: only the cross product says how deep they are.
  for (const double angle : {1e-2, 1e-3, 1e-4}) {
    const double length = 2 / angle;
    Box i = turned({.body = 0, .x = Vec3::Zero(), .axes = Mat3::Identity(), .half_sides = Vec3(length, 1, 1)},
                   std::numbers::pi / 4, Vec3::UnitX());
    Box j = turned(i, angle, Vec3::UnitZ());
    j.body = 1;
    j.x = Vec3(0, 0, 2 * std::sqrt(2.0) - 0.02);
    const auto got = separating_axis(i, j);
    given() = "given two rails, " + show(2 * length) +
              " m long, 0.02 m deep in each other where their edges cross at " + show(angle) + " rad";
    if (!expect_sound(got, i, j)) return;
    expect_near("g [m]", "Eq. (8.6), (8.7)", got.gap, -0.02, {1e-8, "roundings of the length of a rail"}, {},
                "The edges are nearly parallel, but not quite: a cross product is left out only where its "
                "length is "
                "1e-6 or less.");
    if (::testing::Test::HasFailure()) return;
  }
}

EXERCISE_TEST(SeparatingAxis, DropsNothingSmall) {
  // A ridge along x, and upon it one along y that leans by a little: n leans with it.
  const Box cube{.body = 0, .x = Vec3::Zero(), .axes = Mat3::Identity(), .half_sides = Vec3::Constant(0.5)};
  const Box i = turned(cube, std::numbers::pi / 4, Vec3::UnitX());
  for (const double part : relative_scales) {
    Box j = turned(turned(cube, std::numbers::pi / 4, Vec3::UnitY()), part, Vec3::UnitX());
    j.body = 1;
    j.x = Vec3(0.1, -0.2 * part, std::sqrt(2.0) - 0.02);
    given() = describe_both(i, j);
    const auto got = separating_axis(i, j);
    expect_true("edges " + std::to_string(got.edge_i) + " of i and " + std::to_string(got.edge_j) + " of j",
                "Eq. (8.7)", got.edge_i == 0 && got.edge_j == 1, "The ridges are i's x axis and j's y axis.");
    expect_near_vector("n between two ridges of which one leans by " + show(part) + " rad", "Eq. (8.6), (8.7)",
                       got.n, Vec3(0, -std::sin(part), std::cos(part)), roundings(16), {}, small_is_dropped);
    if (::testing::Test::HasFailure() || !expect_sound(got, i, j)) return;
  }
}

EXERCISE_TEST(SeparatingAxis, DropsNothingOfThinBoxes) {
  // Plates, rods, and boxes ten million times as large as others.
  Random random;
  int of_edges = 0;
  for (int trial = 0; trial < 2000 && !::testing::Test::HasFailure(); ++trial) {
    Box i = random_box(random, 0), j = random_box(random, 1);
    for (Box* box : {&i, &j}) {
      for (int k = 0; k < 3; ++k)
        if (random.integer(0, 2) == 0) box->half_sides[k] *= 1e-7;
      if (random.integer(0, 2) == 0) box->half_sides *= 1e7;
    }
    if (random.integer(0, 2) == 0) j.axes = i.axes;
    const double size_i = i.half_sides.norm(), size_j = j.half_sides.norm();
    const double reach = trial % 2 ? size_i + size_j : std::min(size_i, size_j);
    const double distance = random.uniform(0, reach);
    j.x = i.x + distance * random.unit_vector();
    given() = describe_both(i, j);
    const auto got = separating_axis(i, j);
    of_edges += got.edge_i >= 0;
    if (!expect_sound(got, i, j)) return;
  }
  expect_at_least("(of this test) pairs, of 2000, of which edges are chosen", "Eq. (8.7)", of_edges, 100,
                  "many are");
}

EXERCISE_TEST(SeparatingAxis, NoDirectionHasALargerGap) {
  Random random;
  for (int trial = 0; trial < 100 && !::testing::Test::HasFailure(); ++trial) {
    const Box i = random_box(random, 0), j = random_box(random, 1);
    const auto got = separating_axis(i, j);
    if (got.gap > 0) continue;
    given() = describe_both(i, j);
    double most = -infinity;
    for (int k = 0; k < 2000; ++k) most = std::max(most, gap_along(i, j, random.unit_vector()));
    expect_at_most("the largest g along 2000 random directions [m]", "Eq. (8.7)", most,
                   got.gap + 3 * margin(got.gap, i, j),
                   "g along the axis returned: of boxes that overlap none is more open than the best of the 15",
                   "An axis is missing, or the deepest has been taken for the least deep.");
  }
}

/// From i to j by projected gradients, without any axes: a point goes to and fro between the boxes.
Vec3 shortest_way(const Box& i, const Box& j) {
  const auto into = [](const Box& box, const Vec3& p) {
    const Vec3 seen = box.axes.transpose() * (p - box.x);
    return Vec3(box.x + box.axes * seen.cwiseMax(-box.half_sides).cwiseMin(box.half_sides));
  };
  Vec3 p = i.x, q = into(j, p);
  for (int k = 0; k < 2000 && (q - p).norm() > 1e-9; ++k) {
    p = into(i, q);
    q = into(j, p);
  }
  return q - p;
}

EXERCISE_TEST(SeparatingAxis, PartsWhatTouchesAlongAnotherAxis) {
  // Along x, an axis of i, the gap is exactly 0, and along one of j's own axes the boxes are apart.
  const Box i{.body = 0, .x = Vec3::Zero(), .axes = Mat3::Identity(), .half_sides = Vec3::Constant(0.25)};
  Box j{.body = 1, .x = Vec3::Zero(), .axes = Mat3::Identity(), .half_sides = Vec3(1, 1, 1)};
  j.axes.col(0) = Vec3(0.6, 0, 0.8), j.axes.col(2) = Vec3(-0.8, 0, 0.6);
  j.x = Vec3(0.25 + half_width(j, Vec3::UnitX()), 0, 1);
  for (const bool exchanged : {false, true}) {
    const Box &first = exchanged ? j : i, &second = exchanged ? i : j;
    given() = describe_both(first, second);
    expect_at_least("g of boxes that just touch along one axis, and are apart along another [m]", "Eq. (8.7)",
                    separating_axis(first, second).gap, 1e-300, "positive",
                    "A gap of 0 parts nothing: look on, as long as none is positive.");
  }
}

EXERCISE_TEST(SeparatingAxis, PartsWhatIsApart) {
  Random random;
  int apart = 0, together = 0;
  for (int trial = 0; trial < 500 && !::testing::Test::HasFailure(); ++trial) {
    const Box i = random_box(random, 0), j = random_box(random, 1);
    const auto got = separating_axis(i, j);
    const double gap = got.gap;
    const Vec3 way = shortest_way(i, j);
    given() = describe_both(i, j);
    if (!expect_sound(got, i, j)) return;
    if (way.norm() <= 1e-9) {
      ++together;
      expect_at_most("g of two boxes that have a point in common [m]", "Eq. (8.7)", gap, 1e-8,
                     "not positive; 1e-9 m is where the search for a common point ends", "ρ = Σ h_k |n·e_k|.");
    } else if (gap_along(i, j, way.normalized()) > 1e-9) {
      ++apart;
      expect_at_least("g of two boxes that a plane across " + show(way) + " parts [m]", "Eq. (8.7)", gap,
                      1e-300, "positive: one of the 15 axes parts them, too",
                      "An axis is missing: three of i, three of j, nine of edges.");
    }
  }
  expect_at_least("boxes, of 500 pairs, that are apart", "Eq. (8.7)", apart, 50, "many are");
  expect_at_least("boxes, of 500 pairs, that are not", "Eq. (8.7)", together, 50, "many are");
}

EXERCISE_TEST(SeparatingAxis, PartsWhatIsApartByLessThanAMargin) {
  // Tilted by so little that the face of i still overlaps, and that of j is just free.
  const double tilt = 1e-8;
  const Box cube{.body = 0, .x = Vec3::Zero(), .axes = Mat3::Identity(), .half_sides = Vec3(1, 1, 1)};
  for (const auto& [side, size] : {std::pair(-1.0, 1.0), {1.0, 1.0}, {1.0, 1e-6}}) {
    Box i = turned(cube, side * tilt, Vec3::UnitX());
    Box j{
        .body = 1, .x = Vec3(0, side * 1.5, 2 + 1.5 * tilt), .axes = cube.axes, .half_sides = cube.half_sides};
    j.x *= size, i.half_sides *= size, j.half_sides *= size;
    const auto got = separating_axis(i, j);
    given() = "given two cubes of " + show(2 * size) +
              " m that are 2.5e-9 of that apart along z, the axis of j, and overlap along that of i, tilted "
              "by\n" +
              show(side * tilt) + " rad; j is at " + show(j.x);
    expect_at_least(
        "g [m]", "Eq. (8.7)", got.gap, 1e-300, "positive",
        "One axis with a positive gap is enough: nothing overlaps along it. It need not beat anything by a "
        "margin.");
    if (::testing::Test::HasFailure()) return;
  }
}

EXERCISE_TEST(SeparatingAxis, PartsWhatIsApartByHardlyAnything) {
  // Nearly straight cubes, apart along one axis of the first; along another they overlap by less than a margin.
  Random random;
  for (int trial = 0; trial < 200 && !::testing::Test::HasFailure(); ++trial) {
    const double size = trial % 2 ? 1 : 1e-6;
    const int k = random.integer(0, 2), across = (k + random.integer(1, 2)) % 3;
    const Box i{.body = 0, .x = Vec3::Zero(), .axes = Mat3::Identity(), .half_sides = Vec3::Constant(size)};
    Box j = turned(i, 1e-8, random.unit_vector());
    j.body = 1;
    j.x[k] = size * (1 + 1e-10) + half_width(j, Vec3::Unit(k));
    j.x[across] = size * (1 - 1e-8) + half_width(j, Vec3::Unit(across));
    j.x[3 - k - across] = random.uniform(-1, 1) * size;
    const Box &first = trial % 4 < 2 ? i : j, &second = trial % 4 < 2 ? j : i;
    given() = describe_both(first, second);
    expect_at_least("g of cubes that are apart by 1e-10 of their size [m]", "Eq. (8.7)",
                    separating_axis(first, second).gap, 1e-300, "positive",
                    "One axis with a positive gap is enough, however small it is: it needs no margin.");
  }
}

EXERCISE_TEST(SeparatingAxis, PartsEdgesThatAreApartByHardlyAnything) {
  // The rim of a cube, and across it the edge of another that is tilted so little that the faces of both still overlap,
  // by less than a margin. Each of the nine pairs of edges.
  Random random;
  for (int pair = 0; pair < 9; ++pair)
    for (const double size : {1.0, 1e-6}) {
      const Mat3 world = random.rotation().toRotationMatrix();
      const double tilt = 1e-8, gap = 1e-10;
      const auto cube = [&](int body, const Mat3& axes, int first) {
        Box box{.body = body, .x = Vec3::Zero(), .axes = axes, .half_sides = Vec3::Constant(size)};
        for (int k = 0; k < 3; ++k) box.axes.col((first + k) % 3) = axes.col(k);
        return box;
      };
      const Box i = cube(0, world, pair % 3);
      // Its edge along x goes down outwards, over the rim along y; from there its lower face goes up.
      const Mat3 tilted =
          world *
          (Eigen::AngleAxisd(tilt, Vec3::UnitX()) * Eigen::AngleAxisd(tilt, Vec3::UnitY())).toRotationMatrix();
      Box j = cube(1, tilted, pair / 3);
      j.x = size * (world * Vec3(1, 0.5, 1 + gap) - tilted * Vec3(-0.5, -1, -1));
      given() = describe_both(i, j);
      const auto all = all_axes(i, j);
      expect_true("(of this test) faces overlap, and edges do not", "Eq. (8.6)",
                  std::max(best_of(all, 0), best_of(all, 1)) < 0 && best_of(all, 2) > 0);
      expect_at_least("g of cubes whose edges are apart by 1e-10 of their size [m]", "Eq. (8.7)",
                      separating_axis(i, j).gap, 1e-300, "positive",
                      "One axis with a positive gap is enough, however small it is: it needs no margin.");
      if (::testing::Test::HasFailure()) return;
    }
}

EXERCISE_TEST(SeparatingAxis, StaysWithFacesThatLieOnEachOther) {
  Random random;
  const Box i{.body = 0, .x = Vec3::Zero(), .axes = Mat3::Identity(), .half_sides = Vec3(1, 1, 0.5)};
  for (int trial = 0; trial < 600 && !::testing::Test::HasFailure(); ++trial) {
    // So little that 5 per cent of it are less than what it trembles by: the thousandth has to hold the face then. And
    // as much as a box tilts that sags at one side.
    const bool sags = trial % 4 == 3;
    const double depth = sags ? 2e-4 : trial % 2 ? 1e-3 : 2e-9, trembles = sags ? 1e-4 : 1e-9;
    Box j{.body = 1, .x = Vec3(0.3, 0.2, 1 - depth), .axes = Mat3::Identity(), .half_sides = Vec3(1, 1, 0.5)};
    if (trial > 200) j = turned(j, trial > 400 ? random.uniform(-3, 3) : std::numbers::pi / 4, Vec3::UnitZ());
    j.x += random.vector(trembles);
    const double angle = random.uniform(-trembles, trembles);
    j = turned(j, angle, random.unit_vector());
    given() = "given a box that lies on another, " + show(depth) + " m deep, and trembles by " +
              show(trembles) + ": " + describe(j);
    const auto got = separating_axis(i, j);
    if (!expect_sound(got, i, j)) return;
    expect_true(
        "the upper face of i is met: face_i = " + std::to_string(got.face_i) + ", n = " + show(got.n),
        "Eq. (8.7)", got.face_i == 2 && got.n.z() > 0.5,
        got.face_j == 2   ? "A face of j is as good as that of i, but for roundings or sag, which must not "
                            "choose: it has to be better by the margin."
        : got.edge_i >= 0 ? "Edges that are nearly parallel to the faces are as good as the face, but for "
                            "roundings or sag, which must not choose: they have to be better by the margin."
                          : "");
  }
}

EXERCISE_TEST(SeparatingAxis, ParallelEdgesHaveNoAxis) {
  Random random;
  for (int draw = 0; draw < 200; ++draw) {
    const double angle = std::array{0.0, 1e-16, 1e-12, 1e-8, 1e-7}[static_cast<std::size_t>(draw % 5)];
    const Box i = random_box(random, 0);
    Box j = turned(i, angle, i.axes.col(1));
    j.body = 1;
    j.x += 1.99 * i.half_sides[0] * i.axes.col(0);
    const auto got = separating_axis(i, j);
    given() = "given a box beside its copy, turned by " + show(angle) + " rad";
    expect_true("n is finite", "Eq. (8.7)", got.n.allFinite() && std::isfinite(got.gap),
                "e_a × e_b of parallel edges is 0, and has no direction: leave such pairs out.");
    if (::testing::Test::HasFailure() || !expect_sound(got, i, j)) return;
    expect_near(
        "g [m]", "Eq. (8.6)", got.gap, -0.01 * i.half_sides[0], {2e-6, "1e-7 rad times its sides"}, {},
        "A cross product of parallel edges is all roundings: it must not be normalised. Leave out what is "
        "shorter than 1e-6.");
  }
}

}  // namespace
