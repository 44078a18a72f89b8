// The nearest point of a disc.
#include "exercise_test.hpp"
#include "friction_systems.hpp"

using namespace spook;
using namespace spook::testing;

namespace {

EXERCISE(OntoDisc, "9.4 onto_disc");

EXERCISE_TEST(OntoDisc, LeavesWhatIsInside) {
  for (const Vec2& inside : {Vec2(3, 4), Vec2(-3, 4), Vec2(0.1, 0), Vec2(0, 0)})
    for (const double radius : {5.0, 6.0, infinity})
      expect_near_vector(
          "λ_t = " + show(Eigen::MatrixXd(inside)) + " N s in a disc of " + show(radius) + " N s", "Eq. (9.4)",
          onto_disc(inside, radius), inside, {0, "exact"},
          {{Vec2(radius / 5 * inside),
            "This is on the edge, but friction inside the disc does not change. Use min(1, Λ/|λ_t|)."}},
          "A λ_t inside the disc or on its edge does not change, also where a division would be 0/0 or ∞/∞.");
}

EXERCISE_TEST(OntoDisc, ShortensWhatIsOutside) {
  const Vec2 lambda(-3, 4);
  expect_near_vector(
      "λ_t = (-3, 4) N s, onto a disc of 2.5 N s", "Eq. (9.4)", onto_disc(lambda, 2.5), Vec2(-1.5, 2),
      roundings(8, 4),
      {{Vec2(-2.5, 2.5),
        "This is the box, which bounds each component separately. The disc shortens both by "
        "one factor."},
       {lambda, "It has not been shortened: |λ_t| = 5."},
       {Vec2(-3, 4) / 5, "This has length 1. Multiply by the radius."},
       {Vec2(-7.5, 10), "This is Λ λ_t: divide by |λ_t|, too."},
       {Vec2(-0.3, 0.4), "This is divided by |λ_t| once too often: the factor is Λ/|λ_t|."},
       {Vec2(1.5, -2), "The direction has been reversed."},
       {Vec2(-7.5, 10) / 7, "The length is √(λ1² + λ2²), not |λ1| + |λ2|."},
       {Vec2(-2.5 * 0.75, 2.5), "The length is √(λ1² + λ2²), not the larger of |λ1| and |λ2|."}});
}

// p is the nearest point of a disc to λ if, seen from p, no point q of it lies on λ's side: (λ - p)·(q - p) <= 0.
EXERCISE_TEST(OntoDisc, IsTheNearestPoint) {
  Random random;
  for (int trial = 0; trial < 200 && !::testing::Test::HasFailure(); ++trial) {
    const Vec2 lambda{random.uniform(-2, 2), random.uniform(-2, 2)};
    const double radius = random.log_uniform(1e-3, 10), angle = random.uniform(0, 6.3);
    const Vec2 p = onto_disc(lambda, radius);
    const Vec2 q = random.uniform(0, radius) * Vec2(std::cos(angle), std::sin(angle));
    const std::string of = " of λ_t = " + show(Eigen::MatrixXd(lambda)) + ", radius " + show(radius) + " [N s]";
    expect_at_most("length of the nearest point" + of, "Eq. (9.4)", p.norm(), radius * (1 + roundings(8).value),
                   "the radius, and 8 roundings");
    expect_at_most("(λ - p)·(q - p) for your result p and a point q of the disc" + of, "Eq. (9.4)",
                   (lambda - p).dot(q - p), roundings(32, 4 * (1 + radius) * (1 + radius)).value,
                   "0, and 32 roundings", "There is a nearer one. It is on the line from 0 to λ_t.");
  }
}

EXERCISE_TEST(OntoDisc, TakesInWhatIsJustOutside) {
  for (const double beyond : {1e-12, 1e-9, 1e-6, 1e-3})
    for (const Vec2& edge : {Vec2(3, 4), Vec2(-5, 0)})
      expect_near_vector(
          "λ_t = (1 + " + show(beyond) + ") " + show(Eigen::MatrixXd(edge)) + " N s, onto a disc of 5",
          "Eq. (9.4)", onto_disc((1 + beyond) * edge, 5), edge, roundings(16, 5), {},
          "It is slightly outside and must be shortened: compare |λ_t| <= Λ without a tolerance.");
}

EXERCISE_TEST(OntoDisc, IsNothingForNoRadius) {
  for (const Vec2& lambda : {Vec2(0, 0), Vec2(3, -4), Vec2(1e-12, 0)})
    expect_near_vector("λ_t = " + show(Eigen::MatrixXd(lambda)) + " N s, onto a disc of 0", "Eq. (9.4)",
                       onto_disc(lambda, 0), Vec2::Zero(), {0, "exact"}, {},
                       "The disc of radius 0 is a point, also for λ_t = 0, where Λ/|λ_t| is 0/0.");
  expect_near_vector("λ_t = 0, onto a disc of 1 N s", "Eq. (9.4)", onto_disc(Vec2::Zero(), 1), Vec2::Zero(),
                     {0, "exact"}, {}, "0 has no direction and needs none, since it is inside.");
}

EXERCISE_TEST(OntoDisc, IsTheSameAtEveryScale) {
  for (const double size : {1e-60, 1e-15, 1e-9, 1e-3, 1e9, 1e60})
    expect_near_vector("λ_t = (3, 4) over " + show(size) + " N s, onto a disc of 2.5", "Eq. (9.4)",
                       Vec2(onto_disc(size * Vec2(3, 4), 2.5 * size) / size), Vec2(1.5, 2), roundings(16, 4),
                       {{Vec2(3, 4),
                         "This small impulse has been left outside. Coulomb's law holds for impulses of any "
                         "size."}},
                       "The answer is the same in any unit of λ.");
}

EXERCISE_TEST(OntoDisc, KeepsANaN) {
  const double nan = std::nan("");
  const std::string clue =
      "std::min and std::max drop a NaN, and a comparison with one is false. `if (|λ_t| <= radius) return "
      "λ_t`, "
      "followed by a division, keeps the NaN.";
  expect_true("λ_t = (NaN, 1) stays a NaN", "Eq. (9.4)", onto_disc(Vec2(nan, 1), 0.5).hasNaN(), clue);
  expect_true("λ_t = (1, NaN) stays a NaN", "Eq. (9.4)", onto_disc(Vec2(1, nan), 0.5).hasNaN(), clue);
  expect_true("λ_t = (NaN, 1) stays a NaN in a disc of 0", "Eq. (9.4)", onto_disc(Vec2(nan, 1), 0).hasNaN(),
              clue);
  expect_true("a radius of NaN makes a NaN", "Eq. (9.4)", onto_disc(Vec2(1, 1), nan).hasNaN(), clue);
}

}  // namespace
