// Bounds of a box: along the axes of the world, and as small as possible.
#include "relative_scales.hpp"
#include "shapes.hpp"

using namespace spook;
using namespace spook::testing;

namespace {

EXERCISE(Bounds, "8.9 bounds");

EXERCISE_TEST(Bounds, AreTheBoxIfItLiesStraight) {
  const spook::Bounds got =
      bounds({.body = 0, .x = Vec3(1, 2, 3), .axes = Mat3::Identity(), .half_sides = Vec3(0.5, 2, 4)});
  expect_near_vector("lower [m]", "Eq. (8.11)", got.lower, Vec3(0.5, 0, -1), roundings(8, 4),
                     {{Vec3(1.5, 4, 7), "This is the upper corner."},
                      {Vec3(-0.5, -2, -4), "The centre is missing."},
                      {Vec3(0.75, 1, 1), "h_k are halves already: no further half."},
                      {Vec3(0, -2, -5), "h_k are halves of the sides, not sides."}},
                     got.lower.x() < 0.5
                         ? "These are too large. Return the smallest bounds, without a margin for round-off."
                         : "x - Σ h_k |e_k|.");
  expect_near_vector("upper [m]", "Eq. (8.11)", got.upper, Vec3(1.5, 4, 7), roundings(8, 4),
                     {{Vec3(0.5, 2, 4), "The centre is missing."}});
}

EXERCISE_TEST(Bounds, HoldEveryCornerAndNoMore) {
  Random random;
  for (int trial = 0; trial < 200 && !::testing::Test::HasFailure(); ++trial) {
    const Box box = random_box(random, 0, 3);
    given() = "given " + describe(box);
    const spook::Bounds got = bounds(box);
    Vec3 lower = Vec3::Constant(infinity), upper = -lower;
    for (const Vec3& corner : corners(box)) {
      lower = lower.cwiseMin(corner);
      upper = upper.cwiseMax(corner);
    }
    const Vec3 once = box.axes * box.half_sides, across = box.axes.cwiseAbs().transpose() * box.half_sides;
    const double sphere = box.half_sides.norm();
    const std::string otherwise = "Each side reaches h_k |e_k| along each axis of the world, and they add up.";
    expect_near_vector(
        "upper, the largest of all corners [m]", "Eq. (8.11)", got.upper, upper, roundings(32, 8),
        {{Vec3(box.x + once), "This is the corner with all signs +. Others may be farther out."},
         {Vec3(box.x + once.cwiseAbs()),
          "This is the absolute value of one corner. Take |e_k| of each term before you add them."},
         {Vec3(box.x + across), "The axes are the columns of `axes`: these are its rows."},
         {Vec3(box.x + box.half_sides), "The box is rotated: its sides are along e_k, not along x, y and z."},
         {Vec3(box.x + Vec3::Constant(sphere)),
          "These are the bounds of the sphere around the box. Smaller bounds exist."}},
        otherwise);
    expect_near_vector(
        "lower, the smallest of all corners [m]", "Eq. (8.11)", got.lower, lower, roundings(32, 8),
        {{Vec3(box.x - once), "This is the corner with all signs -. Others may be farther out."}}, otherwise);
  }
}

EXERCISE_TEST(Bounds, DropNothingSmall) {
  for (const double part : relative_scales)
    for (const Vec3& size : lopsided(part)) {
      const Vec3 half_sides = size.cwiseAbs();
      const spook::Bounds got =
          bounds({.body = 0, .x = Vec3::Zero(), .axes = Mat3::Identity(), .half_sides = half_sides});
      expect_each_near<Vec3>("upper bound of a needle [m]", "Eq. (8.11)", got.upper, half_sides, 4);
      expect_each_near<Vec3>("lower bound of a needle [m]", "Eq. (8.11)", got.lower, -half_sides, 4);
      if (::testing::Test::HasFailure()) return;
    }
}

}  // namespace
