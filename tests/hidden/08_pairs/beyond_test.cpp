// Beyond chapter 08's own tests: exchanged bodies, areas, all axes, corners and pairs tried.
#include <algorithm>
#include <numbers>

#include "08_pairs/pairs.hpp"
#include "exercise_test.hpp"
#include "simulations.hpp"

using namespace spook;
using namespace spook::testing;

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
EXERCISE(StepPairs, "8.12 step_pairs");

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
    // Which of two nearly equal axes is kept may depend on the order: 5 per cent of the gap, and a thousandth
    // of a side.
    expect_near("g(n) [m]", "Eq. (8.7)", other, gap, {0.06 * std::abs(gap) + 4e-3, "the margins"});
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

EXERCISE_TEST(Bounds, AreThoseOfEightCorners) {
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

EXERCISE_TEST(PlaneBall, IsRightForAnyPlane) {
  Random random;
  for (const double depth : {0.3, 1e-9, 0.0, -1e-9, -1.0}) {
    const Plane plane{.body = 4, .x = random.vector(), .n = Vec3::Unit(random.integer(0, 2)), .offset = 0.5};
    Ball ball{.body = 2, .x = random.vector(), .radius = 2};
    ball.x += (plane.offset + ball.radius - depth - ball.x.dot(plane.n)) * plane.n;
    const auto contact = plane_ball(plane, ball);
    if (depth != 0)
      expect_true("there is a contact where the gap is not positive", "Eq. (8.1)",
                  contact.has_value() == (depth > 0));
    if (!contact) continue;
    expect_near("gap [m]", "Eq. (8.1)", contact->gap, -depth, roundings(16, 4));
    expect_near_vector("arm of the ball [m]", "Eq. (8.3)", contact->r_j, Vec3(-2 * plane.n), roundings(16, 4));
    expect_near_vector("arm of the plane's body [m]", "Eq. (8.3)", contact->r_i,
                       Vec3(ball.x - 2 * plane.n - plane.x), roundings(32, 4));
    expect_true("i is the plane's body, and n its normal", "Eq. (8.1)",
                contact->i == 4 && contact->j == 2 && contact->n == plane.n);
  }
}

/// Numbers of contacts that do not depend on their order: how many, and sums of gaps, arms and normals.
Eigen::VectorXd sums_of(const std::vector<Contact>& contacts) {
  Eigen::VectorXd sums = Eigen::VectorXd::Zero(14);
  for (const Contact& c : contacts) {
    sums[0] += 1;
    sums[1] += c.gap;
    sums[2] += c.gap * c.gap;
    sums.segment<3>(3) += c.r_i;
    sums.segment<3>(6) += c.r_j;
    sums.segment<3>(9) += c.n;
    sums[12] += c.i, sums[13] += c.j;
  }
  return sums;
}

EXERCISE_TEST(PlaneBox, FindsEveryCornerBelow) {
  Random random;
  for (int k = 0; k < 30; ++k) {
    const Box box = any_box(random, 1, 0.5);
    const Plane plane{
        .body = 6, .x = random.vector(), .n = random.unit_vector(), .offset = random.uniform(-1, 1)};
    std::vector<Contact> expected,
        got = {{.i = 9, .j = 8, .n = Vec3::UnitX(), .gap = 7, .r_i = plane.x, .r_j = plane.x}};
    expected = got;  // found before, and kept
    for (int corner = 0; corner < 8; ++corner) {
      const Vec3 signs(corner & 1 ? 1 : -1, corner & 2 ? 1 : -1, corner & 4 ? 1 : -1);
      const Vec3 r = box.axes * signs.cwiseProduct(box.half_sides);
      const double gap = plane.n.dot(box.x + r) - plane.offset;
      if (gap <= 0)
        expected.push_back({.i = 6, .j = 1, .n = plane.n, .gap = gap, .r_i = box.x + r - plane.x, .r_j = r});
    }
    plane_box(plane, box, got);
    expect_near_vector<Eigen::VectorXd>("number of contacts, then sums of gaps, arms, normals and bodies",
                                        "Eq. (8.4)", sums_of(got), sums_of(expected), roundings(500, 20));
  }
}

EXERCISE_TEST(BallBall, IsRightApartAndAtOnePlace) {
  Random random;
  for (const double distance : {2.5, 1.5 + 1e-9, 1.4, 1e-9}) {
    const Ball i{.body = 3, .x = random.vector(), .radius = 1};
    const Vec3 way = random.unit_vector();
    const Ball j{.body = 1, .x = i.x + distance * way, .radius = 0.5};
    const auto contact = ball_ball(i, j);
    expect_true("there is a contact where the gap is not positive", "Eq. (8.2)",
                contact.has_value() == (distance < 1.5));
    if (!contact) continue;
    expect_near("gap [m]", "Eq. (8.2)", contact->gap, distance - 1.5, roundings(16, 4));
    expect_near_vector("n from i to j", "Eq. (8.2)", contact->n, way, roundings(16 / distance, 4));
    expect_near_vector("arm of i [m]", "Eq. (8.3)", contact->r_i, Vec3((1 + (distance - 1.5) / 2) * contact->n),
                       roundings(32, 4));
    expect_near_vector("arm of j [m]", "Eq. (8.3)", contact->r_j, Vec3(contact->r_i + i.x - j.x),
                       roundings(32, 4));
  }
  const Ball one{.body = 0, .x = Vec3(1, 2, 3), .radius = 1};
  const auto same = ball_ball(one, {.body = 1, .x = one.x, .radius = 1});
  expect_true("two balls at one place touch, along a unit normal", "Eq. (8.2)",
              same && std::abs(same->n.norm() - 1) < 1e-12 && same->gap == -2);
}

EXERCISE_TEST(BoxBall, LeavesByTheNearestFace) {
  Random random;
  for (int k = 0; k < 30; ++k) {
    Box box = any_box(random, 3, 1);
    const int axis = k % 3;
    const double side = k % 2 ? 1 : -1, depth = random.uniform(0.01, 0.2);
    Vec3 inside = random.vector(0.05).cwiseProduct(box.half_sides);
    inside[axis] = side * (box.half_sides[axis] - depth);
    const auto contact = box_ball(box, {.body = 2, .x = box.x + box.axes * inside, .radius = 0.1});
    expect_true("a centre inside the box touches", "Eq. (8.5)", contact.has_value());
    if (!contact) return;
    expect_near("gap [m]", "Eq. (8.5)", contact->gap, -depth - 0.1, roundings(64, 4));
    const Vec3 n = side * box.axes.col(axis);
    expect_near_vector("normal", "Eq. (8.5)", contact->n, n, roundings(16));
    const Vec3 r_j = (-depth - 0.1) / 2 * n + depth * n;  // the middle of the overlap, from the centre
    expect_near_vector("arm of the ball [m]", "Eq. (8.3)", contact->r_j, r_j, roundings(64, 4));
    expect_near_vector("arm of the box [m]", "Eq. (8.3)", contact->r_i, Vec3(r_j + box.axes * inside),
                       roundings(64, 4));
    expect_true("i is the box", "Eq. (8.5)", contact->i == 3 && contact->j == 2);
    const Vec3 far = box.x + (2 * box.half_sides.norm() + 1) * n;
    expect_true("a ball far away does not touch", "Eq. (8.5)",
                !box_ball(box, {.body = 2, .x = far, .radius = 0.1}));
  }
}

/// g(n) of (8.6), by all corners.
double gap_along(const Vec3& n, const Box& i, const Box& j) {
  return n.dot(j.x - i.x) - (i.axes.transpose() * n).cwiseAbs().dot(i.half_sides) -
         (j.axes.transpose() * n).cwiseAbs().dot(j.half_sides);
}

EXERCISE_TEST(SeparatingAxis, IsTheBestOfAllFifteen) {
  Random random;
  for (int k = 0; k < 200; ++k) {
    const Box i = any_box(random, 0, 1.5), j = any_box(random, 1, 1.5);
    double best = -infinity;
    for (int a = 0; a < 3; ++a) {
      for (const Box* box : {&i, &j})
        for (const double sign : {1.0, -1.0}) best = std::max(best, gap_along(sign * box->axes.col(a), i, j));
      for (int b = 0; b < 3; ++b) {
        const Vec3 across = i.axes.col(a).cross(j.axes.col(b));
        if (across.norm() < 1e-3) continue;
        for (const double sign : {1.0, -1.0})
          best = std::max(best, gap_along(sign * across.normalized(), i, j));
      }
    }
    const spook::SeparatingAxis found = separating_axis(i, j);
    expect_true("it says whether the boxes touch", "Eq. (8.7)", (found.gap > 0) == (best > 0));
    expect_near("g(n) of the normal that is returned [m]", "Eq. (8.6)", found.gap, gap_along(found.n, i, j),
                roundings(500, 10));
    expect_at_least("n·(x_j - x_i): the normal is from i to j [m]", "Eq. (8.6)", found.n.dot(j.x - i.x), 0,
                    "it is that way round");
    const bool face = (found.face_i >= 0) != (found.face_j >= 0),
               edges = found.edge_i >= 0 && found.edge_j >= 0;
    expect_true("either one face or both edges are named", "Eq. (8.7)", face != edges);
    if (best <= 0)
      expect_at_least("g(n) [m]", "Eq. (8.7)", found.gap, best - 0.06 * std::abs(best) - 4e-3,
                      "a face is preferred by 5 per cent and a thousandth of a side");
  }
}

EXERCISE_TEST(Clip, KeepsWhatIsBelowThePlane) {
  Random random;
  for (int k = 0; k < 30; ++k) {
    std::vector<Vec3> square = {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(1, 1, 0), Vec3(0, 1, 0)};
    const Vec3 n = random.unit_vector();
    const double offset = k % 3 == 0   ? 5
                          : k % 3 == 1 ? -5
                                       : n.dot(Vec3(0.5, 0.5, 0)) + random.uniform(-0.2, 0.2);
    const std::vector<Vec3> left = clip(square, n, offset);
    if (k % 3 == 0) expect_true("a polygon below the plane stays as it is", "Eq. (8.8)", left == square);
    if (k % 3 == 1) expect_true("of a polygon above it nothing is left", "Eq. (8.8)", left.empty());
    for (const Vec3& corner : left)
      expect_at_most("n·p - offset [m]", "Eq. (8.8)", n.dot(corner) - offset, 1e-14, "round-off");
    for (const Vec3& corner : square)
      if (n.dot(corner) < offset)
        expect_true("a corner below the plane is kept", "Eq. (8.8)",
                    std::count(left.begin(), left.end(), corner) == 1);
  }
  expect_true("of no corners none are left", "Eq. (8.8)", clip({}, Vec3::UnitZ(), 0).empty());
}

/// Returns the corner with the largest n·p, of all eight. Its edge along an axis across n is as far as any.
Vec3 farthest_of_eight(const Box& box, const Vec3& n) {
  Vec3 farthest = box.x;
  for (int corner = 0; corner < 8; ++corner) {
    const Vec3 signs(corner & 1 ? 1 : -1, corner & 2 ? 1 : -1, corner & 4 ? 1 : -1);
    const Vec3 p = box.x + box.axes * signs.cwiseProduct(box.half_sides);
    if (n.dot(p) > n.dot(farthest)) farthest = p;
  }
  return farthest;
}

EXERCISE_TEST(EdgeContact, IsTheMiddleOfTheShortestWay) {
  Random random;
  int seen = 0;
  for (int trial = 0; trial < 200; ++trial) {
    const Box i = any_box(random, trial % 2 ? 2 : 9, 1), j = any_box(random, 5, 1);
    const int edge_i = random.integer(0, 2), edge_j = random.integer(0, 2);
    const Vec3 a = i.axes.col(edge_i), b = j.axes.col(edge_j), across = a.cross(b);
    const double sine = across.norm();
    if (sine < 0.1) continue;
    ++seen;
    const Vec3 n = (trial % 3 ? across : -across) / sine;
    const double gap = gap_along(n, i, j);  // positive or negative: the points are the same
    const Vec3 on_i = farthest_of_eight(i, n), on_j = farthest_of_eight(j, -n);
    // From on_i along one edge by s, along n by the shortest way, and along the other edge back by t to on_j.
    Mat3 ways;
    ways << a, n, -b;
    const Vec3 steps = ways.fullPivLu().solve(on_j - on_i);
    const Vec3 end_on_i = on_i + steps[0] * a, end_on_j = on_j + steps[2] * b;
    const Contact got = edge_contact(i, j, {.n = n, .gap = gap, .edge_i = edge_i, .edge_j = edge_j});
    const Tolerance close = roundings(500 / sine / sine, 10);
    expect_near_vector("x_i + r_i, the middle of the shortest way between two edges [m]", "Eq. (8.9)",
                       Vec3(i.x + got.r_i), Vec3((end_on_i + end_on_j) / 2), close);
    expect_near_vector("x_j + r_j, the middle of the shortest way between two edges [m]", "Eq. (8.9)",
                       Vec3(j.x + got.r_j), Vec3((end_on_i + end_on_j) / 2), close);
    expect_near("gap, the length of the shortest way along n [m]", "Eq. (8.6)", got.gap, steps[1], close);
    expect_true("n and the gap are those of the axis", "Eq. (8.7)", got.n == n && got.gap == gap);
    expect_true("i and j are those given", "Eq. (8.9)", got.i == i.body && got.j == 5);
  }
  expect_at_least("pairs of edges that were looked at", "Eq. (8.9)", seen, 100, "most of 200");
}

/// Returns the same box, with its axes in another order, and the first and the last of them reversed if `side` is -1.
Box renamed(const Box& box, int shift, double side) {
  Box other = box;
  for (int k = 0; k < 3; ++k) {
    other.axes.col((k + shift) % 3) = (k == 1 ? 1 : side) * box.axes.col(k);
    other.half_sides[(k + shift) % 3] = box.half_sides[k];
  }
  return other;
}

EXERCISE_TEST(EdgeContact, CrossesBeyondTheEndsOfTheEdges) {
  // Two beams on their edges, one along x and one at an angle to it. Seen from above their edges cross far from both.
  Random random;
  const double c = std::sqrt(0.5);
  for (int trial = 0; trial < 60; ++trial) {
    const Vec3 half_i = random.vector(0.3, 1), half_j = random.vector(0.3, 1);
    const double angle = random.uniform(0.3, 2.8), gap = random.uniform(-0.1, 0.1);
    const Vec3 along(std::cos(angle), std::sin(angle), 0), aside = Vec3::UnitZ().cross(along);
    Mat3 axes_i, axes_j;
    axes_i << Vec3::UnitX(), Vec3(0, c, c), Vec3(0, -c, c);
    axes_j << along, c * (aside + Vec3::UnitZ()), c * (Vec3::UnitZ() - aside);
    // The upper edge of i is beside its centre, and the lower edge of j beside that of j.
    const Vec3 upper(0, c * (half_i[1] - half_i[2]), c * (half_i[1] + half_i[2]));
    const Vec3 lower = c * (half_j[2] - half_j[1]) * aside - c * (half_j[1] + half_j[2]) * Vec3::UnitZ();
    // From the middle of each edge, whose half length is 1 or less.
    double s = random.uniform(2, 5);
    if (random.integer(0, 1)) s = -s;
    double t = random.uniform(2, 5);
    if (random.integer(0, 1)) t = -t;
    const Vec3 p(s, upper.y(), upper.z() + gap / 2);  // from the centre of i
    const Vec3 apart = p + gap / 2 * Vec3::UnitZ() - t * along - lower;
    // All of it in any world.
    const Mat3 world = random.rotation().toRotationMatrix();
    const Vec3 x = random.vector();
    const int shift_i = random.integer(0, 2), shift_j = random.integer(0, 2);
    const Vec3 n = world.col(2);
    const Box i =
        renamed({.body = 6, .x = x, .axes = world * axes_i, .half_sides = half_i}, shift_i, trial % 2 ? 1 : -1);
    const Box j = renamed({.body = 3, .x = x + world * apart, .axes = world * axes_j, .half_sides = half_j},
                          shift_j, trial % 3 ? 1 : -1);
    const Contact one = edge_contact(i, j, {.n = n, .gap = gap, .edge_i = shift_i, .edge_j = shift_j});
    const Contact other = edge_contact(j, i, {.n = -n, .gap = gap, .edge_i = shift_j, .edge_j = shift_i});
    const Tolerance close = roundings(500, 10);
    const Vec3 r_i = world * p, r_j = world * (p - apart);
    expect_near_vector("arm of i [m]", "Eq. (8.9)", one.r_i, r_i, close);
    expect_near_vector("arm of j [m]", "Eq. (8.9)", one.r_j, r_j, close);
    expect_near_vector("arm of i, for exchanged boxes [m]", "Eq. (8.9)", other.r_j, r_i, close);
    expect_near_vector("arm of j, for exchanged boxes [m]", "Eq. (8.9)", other.r_i, r_j, close);
    expect_true("bodies, n and gap, for exchanged boxes", "Eq. (8.9)",
                one.i == 6 && one.j == 3 && one.n == n && one.gap == gap && other.i == 3 && other.j == 6 &&
                    other.n == -n && other.gap == gap);
  }
}

EXERCISE_TEST(BoxBox, FindsFacesEdgesAndNothing) {
  Random random;
  for (const double depth : {0.02, -0.02}) {
    const Mat3 R = random.rotation().toRotationMatrix();
    const Vec3 x = random.vector();
    const Box low{.body = 5, .x = x, .axes = R, .half_sides = Vec3(2, 2, 0.5)};
    const Box flat{
        .body = 3, .x = x + R * Vec3(0.3, 0.2, 1 - depth), .axes = R, .half_sides = Vec3(1, 0.5, 0.5)};
    std::vector<Contact> contacts;
    box_box(low, flat, contacts);
    expect_true("a face on a face has four contacts, a face above it none", "Eq. (8.8)",
                contacts.size() == (depth > 0 ? 4 : 0));
    Vec3 middle(0, 0, 0);
    for (const Contact& c : contacts) {
      expect_near("gap [m]", "Eq. (8.8)", c.gap, -depth, roundings(100, 4));
      expect_near_vector("normal from i to j", "Eq. (8.7)", c.n, Vec3(R.col(2)), roundings(32));
      expect_true("i and j are those given", "Eq. (8.7)", c.i == 5 && c.j == 3);
      expect_near_vector("one point has both arms [m]", "Eq. (8.3)", Vec3(low.x + c.r_i), Vec3(flat.x + c.r_j),
                         roundings(100, 4));
      middle += c.r_j / 4;
    }
    if (depth > 0 && contacts.size() == 4)
      expect_near_vector("mean of the arms of j [m]", "Eq. (8.8)", middle,
                         Vec3(R * Vec3(0, 0, -0.5 + depth / 2)), roundings(200, 4));
    std::vector<Contact> exchanged;
    box_box(flat, low, exchanged);
    Eigen::VectorXd one = sums_of(contacts), other = sums_of(exchanged);
    expect_near_vector<Eigen::VectorXd>("sums of arms, for exchanged boxes", "Eq. (8.7)",
                                        Eigen::VectorXd(other.segment<3>(6)),
                                        Eigen::VectorXd(one.segment<3>(3)), roundings(200, 20));
  }
  // Two beams that cross, each turned by 45 degrees about its length: an edge on an edge.
  const Mat3 about_x = Quat(Eigen::AngleAxisd(std::numbers::pi / 4, Vec3::UnitX())).toRotationMatrix();
  const Mat3 about_y = Quat(Eigen::AngleAxisd(std::numbers::pi / 4, Vec3::UnitY())).toRotationMatrix();
  const double apart = std::sqrt(2.0) - 0.01;
  const Box along{.body = 0, .x = Vec3(0, 0, 0), .axes = about_x, .half_sides = Vec3(3, 0.5, 0.5)};
  const Box across{.body = 1, .x = Vec3(0.2, 0.1, apart), .axes = about_y, .half_sides = Vec3(0.5, 3, 0.5)};
  std::vector<Contact> crossing;
  box_box(along, across, crossing);
  expect_true("two edges that cross have one contact", "Eq. (8.9)", crossing.size() == 1);
  if (crossing.size() != 1) return;
  expect_near("gap [m]", "Eq. (8.9)", crossing[0].gap, -0.01, roundings(100, 4));
  expect_near_vector("arm of i [m]", "Eq. (8.9)", crossing[0].r_i, Vec3(0.2, 0, apart / 2), roundings(1000, 4));
}

EXERCISE_TEST(SweepAndPrune, RefusesWhatIsNoNumber) {
  const spook::Bounds sound{.lower = Vec3(0, 0, 0), .upper = Vec3(1, 1, 1)};
  const spook::Bounds odd{.lower = Vec3(0, std::nan(""), 0), .upper = Vec3(1, 1, 1)};
  expect_rejects("a bound that is no number", "lower", [&] { sweep_and_prune({sound, odd}); });
  expect_true(
      "bounds that touch are a pair", "Eq. (8.12)",
      sweep_and_prune({sound, {.lower = Vec3(1, 1, 1), .upper = Vec3(2, 2, 2)}}) == std::vector<Pair>{{0, 1}});
}

EXERCISE_TEST(SpatialHash, RefusesWhatIsNoNumber) {
  const spook::Bounds sound{.lower = Vec3(0, 0, 0), .upper = Vec3(1, 1, 1)};
  expect_rejects("an upper bound below the lower", "upper", [&] {
    spatial_hash({sound, {.lower = Vec3(2, 0, 0), .upper = Vec3(1, 1, 1)}});
  });
  expect_true(
      "bounds that touch are a pair", "Eq. (8.14)",
      spatial_hash({sound, {.lower = Vec3(1, 1, 1), .upper = Vec3(2, 2, 2)}}) == std::vector<Pair>{{0, 1}});
}

/// Balls, boxes and planes; contacts by trying all pairs.
EXERCISE_TEST(StepPairs, FindsItsContacts) {
  Random random;
  for (int n = 0; n < 10; ++n) {
    Simulation all;
    all.k = 1e3;
    all.max_sweeps = 3000;
    all.bodies.push_back({.normal = Vec3::UnitZ(), .offset = -1});
    for (int b = 0; b < 12; ++b) {
      all.bodies.push_back(b % 5 == 4 ? random_static_body(random) : random_rigid_body(random));
      if (b % 2)
        all.bodies.back().radius = random.uniform(0.3, 0.6);
      else
        all.bodies.back().half_sides = random.vector(0.2, 0.6);
    }
    all.bodies.push_back(random_rigid_body(random));  // without a shape
    std::vector<Contact> contacts;
    const auto at = [&](int b) -> const RigidBody& { return all.bodies[static_cast<std::size_t>(b)]; };
    const auto box = [&](int b) { return Box{b, at(b).x, at(b).q.toRotationMatrix(), at(b).half_sides}; };
    const auto ball = [&](int b) { return Ball{b, at(b).x, at(b).radius}; };
    const auto add = [&](const std::optional<Contact>& found) {
      if (found) contacts.push_back(*found);
    };
    for (int i = 0; i < 13; ++i)
      for (int j = i + 1; j < 13; ++j) {
        if (at(i).mass == 0 && at(j).mass == 0) continue;
        const Plane plane{.body = 0, .x = at(0).x, .n = at(0).normal, .offset = at(0).offset};
        const bool i_round = at(i).radius > 0, j_round = at(j).radius > 0;
        if (i == 0 && j_round)
          add(plane_ball(plane, ball(j)));
        else if (i == 0)
          plane_box(plane, box(j), contacts);
        else if (i_round && j_round)
          add(ball_ball(ball(i), ball(j)));
        else if (i_round)
          add(box_ball(box(j), ball(i)));
        else if (j_round)
          add(box_ball(box(i), ball(j)));
        else
          box_box(box(i), box(j), contacts);
      }
    Simulation got = all, expected = all;
    step_pairs(got, 0.05);
    step_impacts(expected, contacts, 0.05);
    expect_same_bodies("after a step in which contacts are found", "Eq. (8.1)-(8.12)", got, expected,
                       {1e-6, "what 3000 sweeps leave, in two orders of rows"});
  }
}

EXERCISE_TEST(PlaneBall, TouchesAtZeroAndNotAtNaN) {
  const Plane floor{.body = 0, .x = Vec3(0, 0, 0), .n = Vec3::UnitZ(), .offset = 0};
  expect_true("a gap of 0 is a contact", "Eq. (8.1)", plane_ball(floor, {1, Vec3(3, 4, 0.5), 0.5}).has_value());
  expect_true("a gap that is no number is none", "Eq. (8.1)",
              !plane_ball(floor, {1, Vec3(0, 0, std::nan("")), 0.5}));
}

EXERCISE_TEST(BallBall, TouchesAtZeroAndNotAtNaN) {
  const Ball ball{.body = 0, .x = Vec3(0, 0, 0), .radius = 0.5};
  expect_true("a gap of 0 is a contact", "Eq. (8.2)", ball_ball(ball, {1, Vec3(1, 0, 0), 0.5}).has_value());
  expect_true("a gap that is no number is none", "Eq. (8.2)",
              !ball_ball(ball, {1, Vec3(std::nan(""), 0, 0), 0.5}));
}

EXERCISE_TEST(PlaneBox, TouchesAtZeroAndNotAtNaN) {
  const Plane floor{.body = 0, .x = Vec3(0, 0, 0), .n = Vec3::UnitZ(), .offset = 0};
  Box box{.body = 1, .x = Vec3(0, 0, 0.5), .axes = Mat3::Identity(), .half_sides = Vec3(1, 1, 0.5)};
  std::vector<Contact> contacts;
  plane_box(floor, box, contacts);
  expect_true("corners with a gap of 0 are contacts", "Eq. (8.4)", contacts.size() == 4);
  box.x.z() = std::nan("");
  plane_box(floor, box, contacts);
  expect_true("corners with a gap that is no number are none", "Eq. (8.4)", contacts.size() == 4);
}

EXERCISE_TEST(BoxBall, TouchesAtZeroAndNotAtNaN) {
  const Box box{.body = 1, .x = Vec3(0, 0, 0), .axes = Mat3::Identity(), .half_sides = Vec3(1, 1, 1)};
  expect_true("a gap of 0 is a contact", "Eq. (8.5)", box_ball(box, {2, Vec3(1.5, 0, 0), 0.5}).has_value());
  expect_true("a gap that is no number is none", "Eq. (8.5)",
              !box_ball(box, {2, Vec3(std::nan(""), 0, 0), 0.5}));
  for (const double side : {1.0, -1.0}) {  // at the middle of the box along two axes
    const auto contact = box_ball(box, {2, Vec3(0, side * 0.9, 0), 0.5});
    expect_true("it leaves by the nearest face", "Eq. (8.5)", contact && contact->n == Vec3(0, side, 0));
  }
}

/// Returns the distance of a point from a box along its axes, the largest of three; negative inside.
double outside(const Vec3& p, const Box& box) {
  return ((box.axes.transpose() * (p - box.x)).cwiseAbs() - box.half_sides).maxCoeff();
}

/// Tells whether a face of i or j has its normal within 8 degrees of n.
bool is_nearly_flat(const Box& i, const Box& j, const Vec3& n) {
  const double cosine_i = (i.axes.transpose() * n).cwiseAbs().maxCoeff();
  return std::max(cosine_i, (j.axes.transpose() * n).cwiseAbs().maxCoeff()) >= 0.99;
}

EXERCISE_TEST(BoxBox, HasAPointOnEachBox) {
  Random random;
  int seen = 0;
  for (int k = 0; k < 300; ++k) {
    const Box i = any_box(random, k % 2 ? 3 : 7, 1), j = any_box(random, 5, 1);
    const Contact before{.i = 1, .j = 2, .n = Vec3::UnitX(), .gap = -1, .r_i = i.x, .r_j = j.x};
    std::vector<Contact> found = {before}, exchanged = {before};
    box_box(i, j, found);
    box_box(j, i, exchanged);
    expect_true("what was found before is kept", "Eq. (8.7)",
                !found.empty() && found[0].i == 1 && found[0].j == 2 && found[0].n == Vec3::UnitX());
    const std::vector<Contact> contacts(found.begin() + 1, found.end());
    const bool j_first = j.body < i.body;
    const spook::SeparatingAxis axis = j_first ? separating_axis(j, i) : separating_axis(i, j);
    const Vec3 axis_n = j_first ? -axis.n : axis.n;
    const bool edges = axis.edge_i >= 0, flat = is_nearly_flat(i, j, axis_n);
    expect_true("boxes that overlap have one to eight contacts, others none", "Eq. (8.8)",
                axis.gap > 0 ? contacts.empty() : !contacts.empty() && contacts.size() <= 8);
    if (axis.gap <= 0 && edges && !flat)
      expect_true("edges have one contact, where no face is nearly flat", "Eq. (8.9)", contacts.size() == 1);
    for (const Contact& c : contacts) {
      expect_true("i and j are those given", "Eq. (8.7)", c.i == i.body && c.j == 5);
      if (edges && contacts.size() > 1) {
        // A nearly flat face has replaced the edges. Only their own axis is from centre to centre; this is near it.
        expect_at_least("cosine of the angle between n and the axis of the edges", "Eq. (8.9)", c.n.dot(axis_n),
                        0.99 - 1e-12, "it is that way round, and within 8 degrees");
      } else {
        expect_at_least("n·(x_j - x_i): the normal is from i to j [m]", "Eq. (8.7)", c.n.dot(j.x - i.x), -1e-12,
                        "it is that way round");
        expect_near_vector("n is the separating axis", "Eq. (8.7)", c.n, axis_n, roundings(16));
      }
      expect_near_vector("one point has both arms [m]", "Eq. (8.3)", Vec3(i.x + c.r_i), Vec3(j.x + c.r_j),
                         roundings(200, 4));
      expect_at_most("gap [m]", "Eq. (8.8)", c.gap, 0, "only what touches is a contact");
      if (contacts.size() == 1) continue;  // a corner beside the face
      ++seen;
      // Half the gap from the point along n, to either side, is the surface of a box; a millionth of a side is allowed.
      expect_near("from the surface of i [m]", "Eq. (8.8)", outside(i.x + c.r_i - c.gap / 2 * c.n, i), 0,
                  {1e-5, "ten times the slack"});
      expect_near("from the surface of j [m]", "Eq. (8.8)", outside(i.x + c.r_i + c.gap / 2 * c.n, j), 0,
                  {1e-5, "ten times the slack"});
    }
    Eigen::VectorXd one = sums_of(found), other = sums_of(exchanged);
    expect_near_vector<Eigen::VectorXd>("number of contacts and sums of gaps, for exchanged arguments",
                                        "Eq. (8.7)", Eigen::VectorXd(other.head<3>()),
                                        Eigen::VectorXd(one.head<3>()), roundings(500, 10));
    expect_near_vector<Eigen::VectorXd>("sum of the arms of one box, for exchanged arguments", "Eq. (8.7)",
                                        Eigen::VectorXd(other.segment<3>(6) - before.r_j),
                                        Eigen::VectorXd(one.segment<3>(3) - before.r_i), roundings(500, 20));
  }
  expect_at_least("contacts that were looked at", "Eq. (8.8)", seen, 20,
                  "some of 300 pairs of boxes meet by a face");
}

EXERCISE_TEST(BoxBox, CutsOffWhatHangsOver) {
  Random random;
  for (const double over : {0.0, 0.5, 1.2, 1.8}) {
    const Mat3 R = random.rotation().toRotationMatrix();
    const Vec3 x = random.vector();
    const Box table{.body = 1, .x = x, .axes = R, .half_sides = Vec3(2, 2, 0.5)};
    const Box plank{
        .body = 4, .x = x + R * Vec3(1 + over, 0.3, 0.99), .axes = R, .half_sides = Vec3(1, 0.5, 0.5)};
    std::vector<Contact> contacts;
    box_box(table, plank, contacts);
    expect_true("four contacts", "Eq. (8.8)", contacts.size() == 4);
    Vec3 lower = Vec3::Constant(9), upper = -lower;
    for (const Contact& c : contacts) {
      const Vec3 p = R.transpose() * c.r_i;
      lower = lower.cwiseMin(p), upper = upper.cwiseMax(p);
    }
    expect_near_vector("lower corner of the contacts in the table's axes [m]", "Eq. (8.8)", lower,
                       Vec3(over, -0.2, 0.495), {2e-6, "the slack"});
    expect_near_vector("upper corner of the contacts in the table's axes [m]", "Eq. (8.8)", upper,
                       Vec3(std::min(2.0, 2 + over), 0.8, 0.495), {2e-6, "the slack"});
  }
  for (const double apart : {0.0, 1e-9}) {
    std::vector<Contact> contacts;
    box_box({.body = 0, .x = Vec3(0, 0, 0), .axes = Mat3::Identity(), .half_sides = Vec3(1, 1, 1)},
            {.body = 1, .x = Vec3(0, 0, 2 + apart), .axes = Mat3::Identity(), .half_sides = Vec3(1, 1, 1)},
            contacts);
    expect_true("boxes that just touch have contacts, others none", "Eq. (8.8)",
                contacts.size() == (apart > 0 ? 0 : 4));
  }
}

/// Bodies from a millimetre to metres.
std::vector<spook::Bounds> of_all_sizes() {
  Random random;
  std::vector<spook::Bounds> all;
  for (int k = 0; k < 300; ++k) {
    const double size = random.log_uniform(1e-3, 5);
    const Vec3 lower = random.vector(2), sides = size * random.vector(0.1, 1);
    all.push_back({.lower = lower, .upper = lower + sides});
  }
  return all;
}

std::vector<Pair> by_all_comparisons(const std::vector<spook::Bounds>& all) {
  std::vector<Pair> pairs;
  for (int i = 0; i < std::ssize(all); ++i)
    for (int j = i + 1; j < std::ssize(all); ++j) {
      const auto &a = all[static_cast<std::size_t>(i)], &b = all[static_cast<std::size_t>(j)];
      if ((a.lower.array() <= b.upper.array()).all() && (b.lower.array() <= a.upper.array()).all())
        pairs.emplace_back(i, j);
    }
  return pairs;
}

EXERCISE_TEST(SweepAndPrune, PutsPairsInOrder) {
  const std::vector<spook::Bounds> all = of_all_sizes();
  expect_true("pairs (i, j) with i < j, sorted", "Eq. (8.12)", sweep_and_prune(all) == by_all_comparisons(all));
}

EXERCISE_TEST(SpatialHash, PutsPairsInOrder) {
  const std::vector<spook::Bounds> all = of_all_sizes();
  expect_true("pairs (i, j) with i < j, sorted", "Eq. (8.14)", spatial_hash(all) == by_all_comparisons(all));
}

EXERCISE_TEST(Clip, CountsCornersOnThePlaneOnce) {
  const std::vector<Vec3> square = {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(1, 1, 0), Vec3(0, 1, 0)};
  expect_true("corners on the plane stay, once", "Eq. (8.8)", clip(square, Vec3::UnitX(), 1) == square);
  expect_true("of a square above the plane one side on it stays", "Eq. (8.8)",
              clip(square, Vec3::UnitX(), 0) == std::vector<Vec3>{Vec3(0, 0, 0), Vec3(0, 1, 0)});
  expect_true("a cut through two corners leaves a triangle", "Eq. (8.8)",
              clip(square, Vec3(1, 1, 0), 1) == std::vector<Vec3>{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)});
  for (const double above : {1e-10, 1e-13}) {
    const std::vector<Vec3> left = clip(square, Vec3::UnitX(), 1 - above);
    double farthest = 0;
    for (const Vec3& corner : left) farthest = std::max(farthest, corner.x());
    expect_near("what is hardly above the plane is cut off: largest x [m]", "Eq. (8.8)", farthest, 1 - above,
                roundings(4));
  }
  std::vector<Vec3> round;
  for (int c = 0; c < many; ++c)
    round.emplace_back(std::cos(2 * std::numbers::pi * c / many), std::sin(2 * std::numbers::pi * c / many), 0);
  expect_true("a polygon of many corners stays as it is below the plane", "Eq. (8.8)",
              clip(round, Vec3::UnitZ(), 1) == round);
}

EXERCISE_TEST(PlaneBall, IsTheSameForGrainsAndMountains) {
  Random random;
  for (const double size : {1e-12, 1e-6, 1e6, 1e12}) {
    const Plane plane{.body = 0, .x = random.vector(size), .n = random.unit_vector(), .offset = 0};
    const Vec3 beside = random.vector(size);
    for (const double height : {0.9, 1.1}) {
      const Ball ball{.body = 1, .x = beside + (height * size - plane.n.dot(beside)) * plane.n, .radius = size};
      const auto contact = plane_ball(plane, ball);
      expect_true("it touches below a height of one radius", "Eq. (8.1)", contact.has_value() == (height < 1));
      if (contact)
        expect_near("gap over the size", "Eq. (8.1)", contact->gap / size, height - 1, roundings(16, 2));
    }
  }
}

EXERCISE_TEST(PlaneBox, IsTheSameForGrainsAndPlates) {
  const Plane floor{.body = 0, .x = Vec3(0, 0, 0), .n = Vec3::UnitZ(), .offset = 0};
  for (const double size : {1e-12, 1e-6, 1e6})
    for (const double thin : {1.0, 1e-8}) {
      std::vector<Contact> contacts;
      plane_box(floor,
                {.body = 1,
                 .x = Vec3(0, 0, 0.5 * thin * size),
                 .axes = Mat3::Identity(),
                 .half_sides = size * Vec3(1, 1, thin)},
                contacts);
      expect_true("the four lower corners touch", "Eq. (8.4)", contacts.size() == 4);
      for (const Contact& c : contacts)
        expect_near("gap over the thickness", "Eq. (8.4)", c.gap / (thin * size), -0.5, roundings(16));
    }
}

EXERCISE_TEST(StepPairs, HasTwoPlanesAndStaticBodiesThatOverlap) {
  Simulation all;
  all.k = 1e3;
  all.bodies.push_back({.normal = Vec3::UnitZ()});
  all.bodies.push_back({.normal = Vec3::UnitX()});
  all.bodies.push_back({.x = Vec3(0.45, 3, 0.48), .mass = 1, .principal = Vec3::Constant(0.1), .radius = 0.5});
  all.bodies.push_back({.x = Vec3(0, -3, 0), .radius = 1});
  all.bodies.push_back({.x = Vec3(0.5, -3, 0), .half_sides = Vec3(1, 1, 1)});
  Simulation got = all, expected = all;
  step_pairs(got, 0.05);
  const Contact on_floor{
      .i = 0, .j = 2, .n = Vec3::UnitZ(), .gap = -0.02, .r_i = Vec3(0.45, 3, -0.02), .r_j = Vec3(0, 0, -0.5)};
  const Contact on_wall{
      .i = 1, .j = 2, .n = Vec3::UnitX(), .gap = -0.05, .r_i = Vec3(-0.05, 3, 0.48), .r_j = Vec3(-0.5, 0, 0)};
  step_impacts(expected, {on_floor, on_wall}, 0.05);
  expect_same_bodies("after a step of a ball in a corner, beside static bodies", "Eq. (8.1), (8.3)", got,
                     expected, roundings(400, 10));
}

}  // namespace
