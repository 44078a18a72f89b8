// Beyond chapter 08's own tests: exchanged bodies, areas, and all pairs tried.
#include <algorithm>
#include <numbers>

#include "08_pairs/pairs.hpp"
#include "exercise_test.hpp"

using namespace spook;
using namespace spook::testing;

namespace {

EXERCISE(BallBall, "8.2 ball_ball");
EXERCISE(BoxBall, "8.4 box_ball");
EXERCISE(SeparatingAxis, "8.5 separating_axis");
EXERCISE(Clip, "8.6 clip");
EXERCISE(Bounds, "8.9 bounds");
EXERCISE(SweepAndPrune, "8.10 sweep_and_prune");
EXERCISE(SpatialHash, "8.11 spatial_hash");

spook::Box any_box(Random& random, int body, double spread) {
  const Vec3 x = random.vector(spread);
  const Mat3 axes = random.rotation().toRotationMatrix();
  return {.body = body, .x = x, .axes = axes, .half_sides = random.vector(0.3, 1.5)};
}

EXERCISE_TEST(BallBall, DoesNotAskWhichIsFirst) {
  Random random;
  const Ball i{.body = 0, .x = random.vector(), .radius = random.uniform(1, 2)};
  const Vec3 apart = random.vector_of_length(0.3, 1.9);  // they overlap, whatever their radii
  const Ball j{.body = 1, .x = i.x + apart, .radius = random.uniform(1, 2)};
  const auto one = ball_ball(i, j), other = ball_ball(j, i);
  expect_true("both orders find the contact", "Eq. (8.2)", one && other);
  if (!one || !other) return;
  expect_near("gap [m]", "Eq. (8.2)", other->gap, one->gap, roundings(16, 4));
  expect_near_vector("normal", "Eq. (8.2)", other->n, Vec3(-one->n), roundings(64 / (i.x - j.x).norm(), 4));
  expect_near_vector("arm of i [m]", "Eq. (8.3)", other->r_j, one->r_i, roundings(64 / (i.x - j.x).norm(), 8));
}

EXERCISE_TEST(BoxBall, FindsTheNearestPointOfTheBox) {
  Random random;
  for (int k = 0; k < 30; ++k) {
    const Box box = any_box(random, 0, 1);
    const Vec3 way = random.unit_vector();
    const Vec3 inside = random.vector();
    const Vec3 in_box = inside.cwiseProduct(box.half_sides) + 3 * way;  // far enough to be outside
    const Vec3 nearest = in_box.cwiseMin(box.half_sides).cwiseMax(-box.half_sides);
    const double distance = (in_box - nearest).norm();
    if (distance < 0.1) continue;
    const auto contact = box_ball(box, {.body = 1, .x = box.x + box.axes * in_box, .radius = distance + 0.01});
    expect_true("there is a contact", "Eq. (8.5)", contact.has_value());
    if (!contact) return;
    expect_near("gap [m]", "Eq. (8.5)", contact->gap, -0.01, roundings(64, 6));
    expect_near_vector("normal", "Eq. (8.5)", contact->n, Vec3(box.axes * (in_box - nearest) / distance),
                       roundings(64 / distance, 6));
  }
}

EXERCISE_TEST(SeparatingAxis, IsTheSameForExchangedBoxes) {
  Random random;
  for (int k = 0; k < 50; ++k) {
    const Box i = any_box(random, 0, 1.5), j = any_box(random, 1, 1.5);
    const double gap = separating_axis(i, j).gap, other = separating_axis(j, i).gap;
    expect_true("both orders say whether the boxes touch", "Eq. (8.7)", (gap > 0) == (other > 0));
    if (gap > 0) continue;  // any axis that parts them will do
    // Which of two nearly equal axes is kept may depend on the order: 5 per cent of the gap, and a millionth of
    // a side.
    expect_near("g(n) [m]", "Eq. (8.7)", other, gap, {0.06 * std::abs(gap) + 2e-6, "the margins"});
  }
}

double area(const std::vector<Vec3>& polygon, const Vec3& normal) {
  Vec3 sum = Vec3::Zero();
  for (std::size_t k = 0; k < polygon.size(); ++k) sum += polygon[k].cross(polygon[(k + 1) % polygon.size()]);
  return 0.5 * sum.dot(normal);
}

EXERCISE_TEST(Clip, SplitsTheArea) {
  Random random;
  for (int k = 0; k < 20; ++k) {
    const Mat3 R = random.rotation().toRotationMatrix();
    const Vec3 middle = random.vector();
    std::vector<Vec3> polygon;
    const int corners = random.integer(3, 8);
    for (int c = 0; c < corners; ++c) {
      const double angle = 2 * std::numbers::pi * c / corners;
      polygon.push_back(middle + R * Vec3(std::cos(angle), std::sin(angle), 0));
    }
    const Vec3 n = random.unit_vector();
    const double offset = n.dot(middle) + random.uniform(-0.8, 0.8);
    const double whole = area(polygon, R.col(2));
    const double parts = area(clip(polygon, n, offset), R.col(2)) + area(clip(polygon, -n, -offset), R.col(2));
    expect_near("area of both sides of a cut [m²]", "Eq. (8.8)", parts, whole, roundings(1000, 10));
  }
}

EXERCISE_TEST(Bounds, HoldEveryCornerAndNoMore) {
  Random random;
  const Box box = any_box(random, 0, 3);
  const spook::Bounds found = bounds(box);
  Vec3 lower = Vec3::Constant(1e9), upper = -lower;
  for (int corner = 0; corner < 8; ++corner) {
    const Vec3 signs(corner & 1 ? 1 : -1, corner & 2 ? 1 : -1, corner & 4 ? 1 : -1);
    const Vec3 p = box.x + box.axes * signs.cwiseProduct(box.half_sides);
    lower = lower.cwiseMin(p), upper = upper.cwiseMax(p);
  }
  expect_near_vector("lower [m]", "Eq. (8.11)", found.lower, lower, roundings(64, 6));
  expect_near_vector("upper [m]", "Eq. (8.11)", found.upper, upper, roundings(64, 6));
}

std::vector<Pair> in_order(std::vector<Pair> pairs) {
  for (Pair& pair : pairs)
    if (pair.first > pair.second) std::swap(pair.first, pair.second);
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

void expect_all_pairs(const std::string& equation,
                      const std::function<std::vector<Pair>(const std::vector<spook::Bounds>&)>& find) {
  Random random;
  std::vector<spook::Bounds> all;
  for (int k = 0; k < 200; ++k) {
    const Vec3 lower = random.vector(8), size = random.vector(0.05, 2) * (k % 20 == 0 ? 6.0 : 1.0);
    all.push_back({.lower = lower, .upper = lower + size});
  }
  std::vector<Pair> expected;
  for (int i = 0; i < std::ssize(all); ++i)
    for (int j = i + 1; j < std::ssize(all); ++j) {
      const auto &a = all[static_cast<std::size_t>(i)], &b = all[static_cast<std::size_t>(j)];
      if ((a.lower.array() <= b.upper.array()).all() && (b.lower.array() <= a.upper.array()).all())
        expected.emplace_back(i, j);
    }
  const std::vector<Pair> found = in_order(find(all));
  expect_true("the pairs are those that all comparisons find, " + std::to_string(expected.size()) +
                  " of them, each once; found: " + std::to_string(found.size()),
              equation, found == expected);
}

EXERCISE_TEST(SweepAndPrune, FindsWhatAllComparisonsFind) {
  expect_all_pairs("Eq. (8.12)", sweep_and_prune);
}

EXERCISE_TEST(SpatialHash, FindsWhatAllComparisonsFind) {
  expect_all_pairs("Eq. (8.14)", spatial_hash);
}

}  // namespace
