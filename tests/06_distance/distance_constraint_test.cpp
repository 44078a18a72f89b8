// The row of a distance: its gap, its Jacobian, its bounds.
#include "attachments.hpp"
#include "exercise_test.hpp"
#include "relative_scales.hpp"

using namespace spook;
using namespace spook::testing;

namespace {

EXERCISE(DistanceConstraint, "6.1 distance_constraint");

const std::string by_length = "This is p_j - p_i over the length l. Divide by the distance, so that |n| = 1.";

Constraint<6> row_of(const RandomPair& t) {
  return distance_constraint<6>(t.i, t.j, t.length, t.spook);
}

EXERCISE_TEST(DistanceConstraint, MeasuresPointMasses) {
  // 3 m to the right and 4 m up: 5 m, held at 4.
  const Attachment i{.body = 0, .x = Vec3(1, 2, -1)}, j{.body = 1, .x = Vec3(4, 2, 3)};
  const Constraint<3> c = distance_constraint<3>(i, j, 4, {.a = 1, .b = 1, .Sigma = 0});
  expect_near("gap of points at (1, 2, -1) and (4, 2, 3), l = 4 m [m]", "Eq. (6.2)", c.gap, 1, roundings(16, 5),
              {{-1, "The sign: g is the distance minus the length, positive when they are too far apart."},
               {5, "The length is missing: g is the distance minus the length."},
               {4.5, "This is half the difference of the squares. Its rate is not that of the distance."},
               {9,
                "This is the sum of distance and length, or the difference of their squares. g is the distance "
                "minus the length."}},
              "g = |p_j - p_i| - l.");
  const Vec3 n(0.6, 0, 0.8);
  const std::string reversed = "n goes from i's point to j's point. This one goes from j to i.";
  expect_near_vector(
      "Gj", "Eq. (6.3)", c.Gj, n, roundings(8),
      {{-n, reversed}, {5 * n, "This is p_j - p_i: n is a unit vector."}, {5.0 / 4 * n, by_length}}, "Gj = n.");
  expect_near_vector("Gi", "Eq. (6.3)", c.Gi, -n, roundings(8),
                     {{n, "i is pushed along -n: Gi has a minus."},
                      {-5 * n, "This is p_i - p_j: n is a unit vector."},
                      {-5.0 / 4 * n, by_length}},
                     "Gi = -n.");
}

EXERCISE_TEST(DistanceConstraint, IncludesShortArms) {
  const SpookParameters spook{.a = 1, .b = 1, .Sigma = 0};
  for (const double part : relative_scales) {
    // 1 m along z between the centres; the points are beside them, across that.
    const Vec3 r_i(part, 0, 0), r_j(0, part, 0), d = Vec3(0, 0, 1) + r_j - r_i, n = d.normalized();
    const Attachment i{.body = 0, .x = Vec3::Zero(), .r = r_i}, j{.body = 1, .x = Vec3(0, 0, 1), .r = r_j};
    const Constraint<6> c = distance_constraint<6>(i, j, 1, spook);
    expect_near_vector(
        "Gj of points at arms of " + show(part) + " m, 1 m apart", "Eq. (6.3)", c.Gj, twist(n, r_j.cross(n)),
        roundings(4),
        {{twist(Vec3::UnitZ(), r_j.cross(Vec3::UnitZ())),
          "This n goes from centre to centre. It must go from point to point, also for short arms."},
         {twist(n, Vec3::Zero()), "The arm has been left out. A short arm counts, too."}},
        small_is_dropped);
    expect_near_vector("Gi of points at arms of " + show(part) + " m, 1 m apart", "Eq. (6.3)", c.Gi,
                       twist(-n, -r_i.cross(n)), roundings(4),
                       {{twist(-n, -r_j.cross(n)), "This has the arm of j's point: that of i's point is r_i."}},
                       small_is_dropped);
    if (::testing::Test::HasFailure()) return;
  }
}

EXERCISE_TEST(DistanceConstraint, MeasuresFromABodyThatIsNearTheOrigin) {
  for (const double part : relative_scales)
    for (const bool i_is_near : {true, false}) {
      const Attachment near{.body = 0, .x = Vec3(0, 0, part)}, far{.body = 1, .x = Vec3(0, 0, 2)};
      const Constraint<3> c = i_is_near ? distance_constraint<3>(near, far, 1, {.a = 1, .b = 1, .Sigma = 0})
                                        : distance_constraint<3>(far, near, 1, {.a = 1, .b = 1, .Sigma = 0});
      expect_near("gap of points at heights of " + show(part) + " m and 2 m, l = 1 m [m]", "Eq. (6.2)", c.gap,
                  1 - part, roundings(4), {{1, "It is measured from the origin. " + small_is_dropped}},
                  small_is_dropped);
      if (::testing::Test::HasFailure()) return;
    }
}

EXERCISE_TEST(DistanceConstraint, HasANegativeGapWhenCompressed) {
  // The points of the test above, 5 m from each other, held at 7.
  const Attachment i{.body = 0, .x = Vec3(1, 2, -1)}, j{.body = 1, .x = Vec3(4, 2, 3)};
  const Constraint<3> c = distance_constraint<3>(i, j, 7, {.a = 1, .b = 1, .Sigma = 0});
  expect_near("gap of points at (1, 2, -1) and (4, 2, 3), l = 7 m [m]", "Eq. (6.2)", c.gap, -2,
              roundings(16, 5),
              {{2, "The gap has lost its sign, so points that are too close would be pulled together."},
               {0, "The gap is negative here, so that points that are too close are pushed apart."},
               {5, "The length is missing: g is the distance minus the length."}},
              "g = |p_j - p_i| - l, negative when they are too close.");
  expect_near_vector(
      "Gj of the compressed pair", "Eq. (6.3)", c.Gj, Vec3(0.6, 0, 0.8), roundings(8),
      {{Vec3(-0.6, 0, -0.8),
        "n goes from i's point to j's point, whether they are too far apart or too close. The sign is in the "
        "gap."},
       {5.0 / 7 * Vec3(0.6, 0, 0.8), by_length}},
      "Gj = n.");
}

// Any length above 0 is positive: a wire may be nanometres long, and a rod may be compressed to almost 0.
EXERCISE_TEST(DistanceConstraint, TakesAnyPositiveDistance) {
  const SpookParameters spook{.a = 1, .b = 1, .Sigma = 0};
  const Vec3 n(0.6, 0, 0.8);
  for (const double distance : {0.05, 1e-3, 1e-6, 1e-9, 1e-12})
    for (const double length : {distance, 2 * distance, 1.0}) {
      const std::string text =
          " of points at a distance of " + show(distance) + " m, l = " + show(length) + " m";
      const Attachment i{.body = 0, .x = Vec3::Zero()}, j{.body = 1, .x = distance * n};
      std::string refused;
      Constraint<3> c{};
      try {
        c = distance_constraint<3>(i, j, length, spook);
      } catch (const std::invalid_argument& error) {
        refused = error.what();
      }
      expect_true(
          "the row" + text + " is made" + (refused.empty() ? "" : "; here: " + refused), "Eq. (6.2)",
          refused.empty(),
          "Any distance above 0 is positive. Only 0 itself has no direction, so do not use a tolerance.");
      if (::testing::Test::HasFailure()) return;
      expect_near(
          "gap" + text + " [m]", "Eq. (6.2)", c.gap, distance - length,
          roundings(8, std::max(distance, length)),
          {{0, "This small gap has been dropped. The gap is the distance minus the length at any size."}},
          "g = |p_j - p_i| - l.");
      expect_near_vector("Gj" + text, "Eq. (6.3)", c.Gj, n, roundings(8),
                         {{Vec3::Zero(),
                           "The direction is missing. Has this short distance been treated as 0? Or a gap of 0 "
                           "as no constraint? It holds the velocity, too."},
                          {Vec3(distance / length * n), by_length}},
                         "Gj = n, of length 1 at any distance.");
      if (::testing::Test::HasFailure()) return;
    }
}

EXERCISE_TEST(DistanceConstraint, MeasuresFromPointToPoint) {
  const RandomPair t;
  const double got = row_of(t).gap, d = t.distance, l = t.length;
  const Vec3 centres = t.j.x - t.i.x;
  given() += ", l = " + show(l) + " m";
  expect_near(
      "gap between points of two rigid bodies [m]", "Eq. (6.1), (6.2)", got, d - l, roundings(32, t.size()),
      {{l - d,
        "The sign: g is the distance minus the length, positive when they are too far apart and negative when "
        "too close."},
       {0, "The gap is 0. Points that are too close have a negative gap."},
       {d, "The length is missing: g is the distance minus the length."},
       {(d * d - l * l) / 2, "This is half the difference of the squares. g is in metres."},
       {d * d - l * l, "This is the difference of the squares. g is in metres."},
       {centres.norm() - l, "This is the distance of the centres. The points are beside them, at x + r."},
       {(centres + t.j.r).norm() - l, "r_i is missing: both points are beside their body's centre."},
       {(centres - t.i.r).norm() - l, "r_j is missing: both points are beside their body's centre."},
       {(centres - t.j.r + t.i.r).norm() - l,
        "r goes from the centre to the point, so the point is at x + r. This has x - r."}},
      "p = x + r of either body, then g = |p_j - p_i| - l.");
}

EXERCISE_TEST(DistanceConstraint, HasFourBlocks) {
  const RandomPair t;
  const Constraint<6> c = row_of(t);
  const Vec3 n = t.n, between_centres = (t.j.x - t.i.x).normalized();
  const std::string missing = "The angular block is missing: a pull beside the centre also turns the body.";
  const std::string origin =
      "This is the lever arm from the origin. A body turns about its own centre of mass.";
  const std::string centres = "This direction is from centre to centre. n is from point to point.";
  const std::string length = "This has the length of p_j - p_i: n is a unit vector.";
  const auto block = [](const Vec3& along, const Vec3& r) { return twist(along, r.cross(along)); };
  expect_near_vector("Gj", "Eq. (6.3)", c.Gj, block(n, t.j.r), roundings(64, t.size()),
                     {{block(-n, t.j.r), "n goes from i's point to j's point. This one goes from j to i."},
                      {twist(n, Vec3::Zero()), missing},
                      {twist(n, -t.j.r.cross(n)), "The sign of the angular block: it is r_j × n, not n × r_j."},
                      {twist(n, t.i.r.cross(n)), "This used r_i for body j. Each body has its own lever arm."},
                      {twist(n, (t.j.x + t.j.r).cross(n)), origin},
                      {block(between_centres, t.j.r), centres},
                      {block(t.apart(), t.j.r), length},
                      {block(t.apart() / t.length, t.j.r), by_length}},
                     "Gj = (n, r_j × n).");
  expect_near_vector(
      "Gi", "Eq. (6.3)", c.Gi, block(-n, t.i.r), roundings(64, t.size()),
      {{block(n, t.i.r), "i is pushed along -n, both in its linear and its angular part."},
       {twist(-n, Vec3::Zero()), missing},
       {twist(-n, t.i.r.cross(n)), "The sign of the angular block: both parts of Gi have a minus."},
       {twist(-n, -t.j.r.cross(n)), "This used r_j for body i. Each body has its own lever arm."},
       {twist(-n, -(t.i.x + t.i.r).cross(n)), origin},
       {block(-between_centres, t.i.r), centres},
       {block(-t.apart(), t.i.r), length},
       {block(-t.apart() / t.length, t.i.r), by_length}},
      "Gi = (-n, -r_i × n).");
}

EXERCISE_TEST(DistanceConstraint, HoldsPointsOfAnyKind) {
  RandomPair t;
  std::vector<std::string> names = {"too far apart", "too near"};
  for (const auto& kind : kinds_of(t)) names.push_back(kind.first);
  Regions regions(names);
  while (regions.lack_draws()) {
    t = any_pair(t.random);
    auto kinds = kinds_of(t);
    kinds.emplace_back("too far apart", t.distance > t.length);
    kinds.emplace_back("too near", t.distance < t.length);
    const std::string numbers = given();
    regions.draw(kinds);
    given() = numbers + "\n" + given();
    const Constraint<6> c = row_of(t);
    const Tolerance close = roundings(64, t.size() / t.distance);
    expect_near("gap [m]", "Eq. (6.1), (6.2)", c.gap, t.distance - t.length, roundings(32, t.size()),
                {{t.length - t.distance, "The sign: g is the distance minus the length."}},
                "g = |p_j - p_i| - l.");
    expect_near_vector("Gj", "Eq. (6.3)", c.Gj, twist(t.n, t.j.r.cross(t.n)),
                       {close.value * (1 + t.j.r.norm()), close.reason}, {}, "Gj = (n, r_j × n).");
    expect_near_vector("Gi", "Eq. (6.3)", c.Gi, twist(-t.n, -t.i.r.cross(t.n)),
                       {close.value * (1 + t.i.r.norm()), close.reason}, {}, "Gi = (-n, -r_i × n).");
    expect_pulls_and_pushes("a distance", c);
    expect_carries("a distance", c, t);
  }
}

EXERCISE_TEST(DistanceConstraint, PullsAndPushes) {
  const RandomPair t;
  expect_pulls_and_pushes("a distance of rigid bodies", row_of(t));
  expect_pulls_and_pushes("a distance of point masses",
                          distance_constraint<3>({.body = 4, .x = t.i.x}, {.body = 2, .x = t.j.x}, 1, t.spook));
}

EXERCISE_TEST(DistanceConstraint, CarriesTheRestOver) {
  const RandomPair t;
  expect_carries("a distance of rigid bodies", row_of(t), t);
  expect_carries("a distance of point masses",
                 distance_constraint<3>({.body = 4, .x = t.i.x}, {.body = 2, .x = t.j.x}, 1, t.spook), t);
}

// The row compared with the returned gap.
EXERCISE_TEST(DistanceConstraint, TimesVelocityIsTheRateOfTheDistance) {
  RandomPair t;
  const Constraint<6> c = row_of(t);
  const double dt = 1e-5;
  const auto gap_after = [&](double time, const Twist<6>& Wi, const Twist<6>& Wj) {
    return distance_constraint<6>(attachment_after(time, t.i, Wi), attachment_after(time, t.j, Wj), t.length,
                                  t.spook)
        .gap;
  };
  for (int trial = 0; trial < 20 && !::testing::Test::HasFailure(); ++trial) {
    const Twist<6> Wi = t.random.twist();
    const Twist<6> Wj = t.random.twist();
    const double rate = (gap_after(dt, Wi, Wj) - gap_after(-dt, Wi, Wj)) / (2 * dt);
    expect_near(
        "G W against the gap of two moving, turning bodies, differentiated numerically [m/s]",
        "Eq. (6.2), (6.3)", c.Gi.dot(Wi) + c.Gj.dot(Wj), rate,
        {1e-7, "dt²/6 |g'''| < 5e-8, with |p'| < 10, |p''| < 11, |p'''| < 18 at a distance above 1 m"},
        {{-rate, "This is the rate at which the points approach: i and j are exchanged, or the sign of n."}},
        "The distance changes as the velocity of j's point minus that of i's, along n.");
  }
}

EXERCISE_TEST(DistanceConstraint, ConservesTheMomentumOfThePair) {
  const RandomPair t;
  const Constraint<6> c = row_of(t);
  expect_near(
      "length of the linear block of j", "Eq. (6.3)", c.Gj.head<3>().norm(), 1, roundings(8),
      {{t.distance, "This is the distance: divide p_j - p_i by it."}, {t.distance / t.length, by_length}},
      "n is a unit vector.");
  expect_near_vector("sum of the linear blocks", "Eq. (6.3)", Vec3(c.Gi.head<3>() + c.Gj.head<3>()),
                     Vec3::Zero(), roundings(4), {}, "Action equals reaction: n on j, -n on i.");
  expect_near_vector("angular momentum about the origin that an impulse of 1 N s adds [kg m²/s]", "Eq. (6.3)",
                     angular_momentum_of(c, t.i, t.j), Vec3::Zero(), roundings(64, t.size()), {},
                     "Two opposite pulls along the line through both points have no torque. Look at r × n of "
                     "both bodies, and the signs.");
}

EXERCISE_TEST(DistanceConstraint, IsTheSameFromBothEnds) {
  const RandomPair t;
  const Constraint<6> c = row_of(t), other = distance_constraint<6>(t.j, t.i, t.length, t.spook);
  expect_near("gap with i and j exchanged, minus the gap [m]", "Eq. (6.2)", other.gap - c.gap, 0,
              roundings(32, t.size()), {}, "The gap does not depend on the order of i and j.");
  expect_near_vector("Gi with i and j exchanged, against Gj", "Eq. (6.3)", other.Gi, c.Gj,
                     roundings(64, t.size()), {}, "The exchange reverses n, and the sign, too.");
  expect_near_vector("Gj with i and j exchanged, against Gi", "Eq. (6.3)", other.Gj, c.Gi,
                     roundings(64, t.size()), {}, "The exchange reverses n, and the sign, too.");
}

EXERCISE_TEST(DistanceConstraint, RejectsPointsThatCoincide) {
  // Beside their centres, which are apart; every number has few binary digits, so that the distance is 0 exactly.
  const Attachment i{.body = 0, .x = Vec3(1, 2, 3), .r = Vec3(0.5, 0, -0.25)};
  const Attachment j{.body = 1, .x = Vec3(2, 2, 3), .r = Vec3(-0.5, 0, -0.25)};
  const SpookParameters spook{.a = 1, .b = 1, .Sigma = 0};
  const std::string clue =
      "At distance 0 there is no direction, and 0/0 is NaN. See require_positive in require.hpp.";
  expect_rejects(
      "two points of rigid bodies at the same place", "distance",
      [&] { distance_constraint<6>(i, j, 1, spook); }, clue);
  expect_rejects(
      "two point masses at the same place", "distance",
      [&] { distance_constraint<3>({.body = 0, .x = i.x}, {.body = 1, .x = i.x}, 1, spook); }, clue);
}

EXERCISE_TEST(DistanceConstraint, RejectsADistanceThatIsNotFinite) {
  const Attachment i{.body = 0, .x = Vec3(1, 2, 3)};
  const SpookParameters spook{.a = 1, .b = 1, .Sigma = 0};
  distance_constraint<3>(i, {.body = 1, .x = Vec3::Zero()}, 1, spook);
  for (const double x : {std::nan(""), HUGE_VAL})
    expect_rejects(
        "x_j = (" + show(x) + ", 0, 0)", "distance",
        [&] { distance_constraint<3>(i, {.body = 1, .x = Vec3(x, 0, 0)}, 1, spook); },
        "See require_positive in require.hpp. The distance must be finite, too. A comparison with 0 does not "
        "find a NaN.");
}

EXERCISE_TEST(DistanceConstraint, RejectsALengthThatIsNotPositive) {
  const Attachment i{.body = 0, .x = Vec3(1, 2, 3)}, j{.body = 1, .x = Vec3(1, 2, 4)};
  const SpookParameters spook{.a = 1, .b = 1, .Sigma = 0};
  distance_constraint<3>(i, j, 1, spook);
  for (const double length : {0.0, -1.0, std::nan(""), HUGE_VAL})
    expect_rejects(
        "length = " + show(length), "length", [&] { distance_constraint<3>(i, j, length, spook); },
        "See require_positive in require.hpp. Points at distance 0 are a ball joint.");
}

}  // namespace
