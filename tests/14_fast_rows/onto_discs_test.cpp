// Four discs at once: each lane computes chapter 09's onto_disc.
#include "exercise_test.hpp"
#include "packs.hpp"
#include "random_input.hpp"
#include "regions.hpp"

using namespace spook;
using namespace spook::testing;

namespace {

EXERCISE(OntoDiscs, "14.6 onto_discs");

LanePairs pairs_of(const std::array<Vec2, lane_count>& all) {
  LanePairs pairs;
  for (int lane = 0; lane < lane_count; ++lane) pairs.row(lane) = all[lane].transpose().array();
  return pairs;
}

Vec2 in_lane(const LanePairs& pairs, int lane) {
  return pairs.row(lane).matrix().transpose();
}

std::string lane_of(int lane) {
  return " in lane " + std::to_string(lane);
}

EXERCISE_TEST(OntoDiscs, ShortensWhatIsOutside) {
  // Each lane has its own direction and disc, and all points are outside.
  const std::array<Vec2, lane_count> outside = {Vec2(-3, 4), Vec2(8, 6), Vec2(-5, -12), Vec2(24, -7)};
  const Lanes radius(2.5, 1, 6.5, 5);
  const LanePairs got = onto_discs(pairs_of(outside), radius);
  for (int lane = 0; lane < lane_count; ++lane) {
    const Vec2& lambda = outside[lane];
    const double length = lambda.norm(), disc = radius[lane];
    expect_near_vector(
        "λ_t = " + show(Eigen::MatrixXd(lambda)) + " N s onto a disc of " + show(disc) + lane_of(lane),
        "Eq. (14.14)", in_lane(got, lane), disc / length * lambda, roundings(8, disc),
        {{lambda, "It has not been shortened: |λ_t| = " + show(length) + "."},
         {Vec2(lambda.cwiseMax(-disc).cwiseMin(disc)),
          "This is the box, which clamps each component by itself. The disc shortens both by one factor."},
         {Vec2(lambda / length), "This has length 1: multiply by the radius."},
         {Vec2(disc * lambda), "This is Λ λ_t: divide by |λ_t|, too."},
         {Vec2(disc / (length * length) * lambda), "The length is the root of λ1² + λ2²."},
         {Vec2(disc / (std::abs(lambda.x()) + std::abs(lambda.y())) * lambda),
          "The length is √(λ1² + λ2²), not |λ1| + |λ2|."},
         {Vec2(radius[0] / length * lambda), "This is the radius of the first lane. Each lane has its own."},
         {Vec2(disc / outside[0].norm() * lambda),
          "This is the length in the first lane. Each lane has its own."}},
        "Λ/|λ_t| times λ_t, with the numbers of this lane.");
  }
}

EXERCISE_TEST(OntoDiscs, LeavesWhatIsInside) {
  const std::array<Vec2, lane_count> inside = {Vec2(3, 4), Vec2(-3, 4), Vec2(0.1, 0), Vec2(0, 0)};
  for (const double radius : {5.0, 6.0, infinity}) {
    const LanePairs got = onto_discs(pairs_of(inside), Lanes::Constant(radius));
    for (int lane = 0; lane < lane_count; ++lane)
      expect_near_vector(
          "λ_t = " + show(Eigen::MatrixXd(inside[lane])) + " N s in a disc of " + show(radius) + lane_of(lane),
          "Eq. (14.14)", in_lane(got, lane), inside[lane], {0, "exact"},
          {{Vec2(radius / 5 * inside[lane]), "This is on the edge. A point inside does not move."}},
          "A point inside, or on the edge, does not move, also where dividing would be 0/0 or ∞/∞.");
  }
}

// A lane selects by its own comparison: all sixteen patterns of inside and outside.
EXERCISE_TEST(OntoDiscs, SelectsInEachLane) {
  Random random;
  for (int pattern = 0; pattern < 1 << lane_count && !::testing::Test::HasFailure(); ++pattern) {
    std::array<Vec2, lane_count> lambda;
    Lanes radius;
    for (int lane = 0; lane < lane_count; ++lane) {
      lambda[lane] = Vec2{random.uniform(0.1, 2), random.uniform(-2, 2)};
      const double share = random.uniform(0.1, 0.9);
      radius[lane] = lambda[lane].norm() * ((pattern >> lane) % 2 ? share : 1 / share);
    }
    const LanePairs got = onto_discs(pairs_of(lambda), radius);
    for (int lane = 0; lane < lane_count; ++lane) {
      const bool slides = (pattern >> lane) % 2;
      const Vec2 shortened = radius[lane] / lambda[lane].norm() * lambda[lane];
      expect_near_vector(std::string("λ_t [N s] of a contact that ") + (slides ? "slides" : "sticks") +
                             lane_of(lane) + ", with others in the other lanes",
                         "Eq. (14.14)", in_lane(got, lane), slides ? shortened : lambda[lane], roundings(8, 3),
                         {{slides ? lambda[lane] : shortened,
                           "Another lane's comparison has decided here. Select lane by lane."}},
                         "Each lane selects its own case.");
    }
  }
}

EXERCISE_TEST(OntoDiscs, LeavesEmptyLanesZero) {
  for (int filled = 0; filled <= lane_count; ++filled) {
    LanePairs lambda = LanePairs::Zero();
    Lanes radius = Lanes::Zero();
    for (int lane = 0; lane < filled; ++lane) {
      lambda.row(lane) << 3, 4;
      radius[lane] = 1;
    }
    const LanePairs got = onto_discs(lambda, radius);
    for (int lane = 0; lane < lane_count; ++lane)
      expect_near_vector("λ_t" + lane_of(lane) + " with " + std::to_string(filled) + " lanes filled [N s]",
                         "Eq. (14.14)", in_lane(got, lane), lane < filled ? Vec2(0.6, 0.8) : Vec2(0, 0),
                         roundings(8), {},
                         "An empty lane has λ_t = 0 and Λ = 0. There Λ/|λ_t| is 0/0: select the other case.");
  }
}

EXERCISE_TEST(OntoDiscs, IsNothingForNoRadius) {
  const std::array<Vec2, lane_count> lambda = {Vec2(3, -4), Vec2(1e-12, 0), Vec2(-2, 0), Vec2(0, 1e9)};
  const LanePairs got = onto_discs(pairs_of(lambda), Lanes::Zero());
  for (int lane = 0; lane < lane_count; ++lane)
    expect_near_vector("λ_t = " + show(Eigen::MatrixXd(lambda[lane])) + " N s onto a disc of 0" + lane_of(lane),
                       "Eq. (14.14)", in_lane(got, lane), Vec2(0, 0), {0, "exact"},
                       {{lambda[lane], "The old friction stays. A disc of radius 0 is a point."}},
                       "With λ_n = 0 there is no friction.");
}

EXERCISE_TEST(OntoDiscs, TakesInWhatIsJustOutside) {
  const std::array<double, lane_count> beyond = {1e-12, 1e-9, 1e-6, 1e-3};
  LanePairs lambda;
  for (int lane = 0; lane < lane_count; ++lane)
    lambda.row(lane) << 3 * (1 + beyond[lane]), 4 * (1 + beyond[lane]);
  const LanePairs got = onto_discs(lambda, Lanes::Constant(5));
  for (int lane = 0; lane < lane_count; ++lane)
    expect_near_vector("λ_t = (1 + " + show(beyond[lane]) + ") (3, 4) N s onto a disc of 5" + lane_of(lane),
                       "Eq. (14.14)", in_lane(got, lane), Vec2(3, 4), roundings(16, 5), {},
                       "Shorten it, however little it is outside: |λ_t| <= Λ has no tolerance.");
}

// Regions are drawn until each lane has had sticking, sliding and separating contacts.
EXERCISE_TEST(OntoDiscs, IsChapterNinesDiscInEachLane) {
  Random random;
  std::vector<std::string> names;
  for (int lane = 0; lane < lane_count; ++lane)
    for (const std::string what : {"sticks", "slides", "parts"}) names.push_back(what + lane_of(lane));
  Regions regions(names, 10);
  while (regions.lack_draws()) {
    std::array<Vec2, lane_count> lambda;
    Lanes radius;
    for (int lane = 0; lane < lane_count; ++lane) {
      lambda[lane] = Vec2{random.uniform(-2, 2), random.uniform(-2, 2)};
      radius[lane] = std::max(0.0, random.uniform(-0.5, 3));
      const double length = lambda[lane].norm();
      regions.draw({{"sticks" + lane_of(lane), length < radius[lane]},
                    {"slides" + lane_of(lane), 0 < radius[lane] && radius[lane] < length},
                    {"parts" + lane_of(lane), radius[lane] == 0}});
    }
    const LanePairs got = onto_discs(pairs_of(lambda), radius);
    for (int lane = 0; lane < lane_count; ++lane)
      expect_near_vector("λ_t" + lane_of(lane) + " [N s]", "Eq. (14.14), (9.4)", in_lane(got, lane),
                         onto_disc(lambda[lane], radius[lane]), roundings(16, 3), {},
                         "Each lane computes exercise 9.4.");
  }
}

EXERCISE_TEST(OntoDiscs, IsTheSameAtEveryScale) {
  const Lanes size(1e-60, 1e-12, 1e9, 1e60);
  LanePairs lambda;
  lambda << 3 * size, 4 * size;
  const LanePairs got = onto_discs(lambda, 2.5 * size);
  for (int lane = 0; lane < lane_count; ++lane)
    expect_near_vector("λ_t = (3, 4) times " + show(size[lane]) + " N s, onto a disc of 2.5 times that",
                       "Eq. (14.14)", Vec2(in_lane(got, lane) / size[lane]), Vec2(1.5, 2), roundings(16, 4),
                       {{Vec2(3, 4), "This small impulse was treated as inside."}},
                       "Whatever the unit of λ, the result is the same.");
}

EXERCISE_TEST(OntoDiscs, KeepsANaNInItsLane) {
  const double nan = std::nan("");
  const std::string clue =
      "A comparison with a NaN is false. `(length <= radius).select(1, radius / length)` keeps it; min() and "
      "max() may not. Other lanes are not affected.";
  for (int lane = 0; lane < lane_count; ++lane)
    for (int of = 0; of < 3; ++of) {  // a component, or the radius
      LanePairs lambda = LanePairs::Constant(3);
      Lanes radius = Lanes::Constant(2);
      if (of < 2)
        lambda(lane, of) = nan;
      else
        radius[lane] = nan;
      const LanePairs got = onto_discs(lambda, radius);
      for (int other = 0; other < lane_count; ++other)
        expect_true("λ_t" + lane_of(other) + (other == lane ? " has a NaN" : " is a number") + ", where " +
                        (of < 2 ? "λ_t" : "Λ") + lane_of(lane) + " has one",
                    "Eq. (14.14)", in_lane(got, other).hasNaN() == (other == lane), clue);
    }
}

}  // namespace
