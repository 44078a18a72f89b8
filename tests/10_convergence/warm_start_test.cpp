// A start with the impulses of the last step.
#include "exercise_test.hpp"
#include "random_input.hpp"
#include "regions.hpp"
#include "relative_scales.hpp"
#include "stop_rule.hpp"
#include "systems.hpp"

using namespace spook;
using namespace spook::testing;

namespace {

EXERCISE(WarmStart, "10.2 warm_start");

EXERCISE_TEST(WarmStart, SetsImpulsesAndTheirVelocities) {
  Random random;
  Problem<6> p = random_problem(random, 4, 9);
  Eigen::VectorXd impulses(9);
  for (double& impulse : impulses) impulse = random.uniform(0.1, 1);
  for (auto& row : p.rows) row.lambda = 3;
  for (auto& V : p.V) V.setConstant(0.5);
  const Eigen::VectorXd before = flat(p.V);
  warm_start(as_std(impulses), p.rows, p.V);
  expect_near_vector(
      "λ of nine contacts [N s]", "Eq. (10.2)", lambdas(p), impulses, {0, "copies"},
      {{impulses + Eigen::VectorXd::Constant(9, 3), "λ is assigned, not added to what was there."},
       {Eigen::VectorXd::Constant(9, 3), "λ has not been set."}},
      "Each λ is its old impulse, which is within the bounds here: all of it, as it was.");
  set_lambda(p, impulses);  // the expected V goes into p
  const Eigen::VectorXd expected = flat(p.V);
  for (auto& V : p.V) V.setConstant(0.5);
  warm_start(as_std(impulses), p.rows, p.V);
  expect_near_vector(
      "V, all bodies [m/s, rad/s]", "Eq. (10.2)", flat(p.V), expected, roundings(100, 10),
      {{before, "V is unchanged. It must be the effect of the impulses, M⁻¹ Gᵀ λ."},
       {Eigen::VectorXd::Zero(24),
        "V is zero: what the impulses do is missing, and the sweeps would apply it a second time."},
       {expected + before, "V is assigned, whatever it was: set it to zero first."}},
      "V = M⁻¹ Gᵀ λ: begin at zero, then apply_impulse for every row.");
}

EXERCISE_TEST(WarmStart, StaysWithinTheBoundsOfNow) {
  Problem<3> p = stack({1, 1, 1}, 0.1);
  p.rows[1].hi = 0.5;
  p.rows[2].lo = -0.25;
  warm_start({-2, 2, -2}, p.rows, p.V);
  expect_near_vector(
      "λ, started with (-2, 2, -2) within [0, ∞), [0, 0.5], [-0.25, ∞) [N s]", "Eq. (10.2)", lambdas(p),
      Eigen::Vector3d(0, 0.5, -0.25), {0, "bounds"},
      {{Eigen::Vector3d(-2, 2, -2), "The bounds are this step's, and may have changed: clamp to them."},
       {Eigen::Vector3d(0, 2, -0.25), "There is an upper bound, too."},
       {Eigen::Vector3d(0, 0.5, 0), "The lower bound is the row's own `lo`, not always zero."}});
  const Eigen::VectorXd expected = moved(p);
  expect_near_vector("V [m/s]", "Eq. (10.2)", flat(p.V), expected, roundings(16, 4), {},
                     "Scatter the clamped impulse: V must belong to the row's λ.");
}

EXERCISE_TEST(WarmStart, TakesAnyBounds) {
  Random random;
  Regions regions({"below lo", "above hi", "within", "above hi = 0", "lo = hi", "of 0, while λ is not 0",
                   "more than eight bodies", "a hundred rows"});
  while (regions.lack_draws()) {
    const int bodies = random.integer(2, 14), rows = random.integer(0, 3) ? 12 : many;
    Problem<6> p = random_problem(random, bodies, rows);
    std::vector<double> impulses;
    Eigen::VectorXd expected(rows);
    bool below = false, above = false, within = false, to_zero = false, no_room = false, nothing = false;
    for (std::size_t k = 0; k < p.rows.size(); ++k) {
      Row<6>& row = p.rows[k];
      give_any_bounds(random, row);
      row.lambda = random.uniform(-0.5, 0.5);
      const double times = random.integer(0, 3),
                   impulse = impulses.emplace_back(times * random.uniform(-0.2, 0.2));
      expected[static_cast<Eigen::Index>(k)] = std::min(row.hi, std::max(row.lo, impulse));
      below = below || impulse < row.lo, above = above || impulse > row.hi;
      within = within || (row.lo < impulse && impulse < row.hi);
      to_zero = to_zero || (row.hi == 0 && impulse > 0), no_room = no_room || row.lo == row.hi;
      nothing = nothing || (impulse == 0 && row.lambda != std::clamp(0.0, row.lo, row.hi));
    }
    regions.draw({{"below lo", below},
                  {"above hi", above},
                  {"within", within},
                  {"above hi = 0", to_zero},
                  {"lo = hi", no_room},
                  {"of 0, while λ is not 0", nothing},
                  {"more than eight bodies", bodies > 8},
                  {"a hundred rows", rows == many}});
    warm_start(impulses, p.rows, p.V);
    expect_near_vector(
        "λ of " + std::to_string(rows) + " rows [N s]", "Eq. (10.2)", lambdas(p), expected,
        {0, "copies and bounds"}, {{as_eigen(impulses), "They are not clamped to the rows' bounds."}},
        "λ is the clamped impulse, also if that is 0, whatever the row had before. " + ends_early);
    const Eigen::VectorXd V = flat(p.V);
    expect_near_vector("V of all bodies [m/s, rad/s]", "Eq. (10.2)", V, moved(p), roundings(1000, 5), {},
                       "V = M⁻¹ Gᵀ λ, of the clamped λ, for every body.");
  }
}

EXERCISE_TEST(WarmStart, LeavesAResidualOfZeroAtRest) {
  Problem<3> p = stack({3, 1, 4, 1, 5}, 0.01);
  std::vector<double> impulses;
  double above = 14;
  for (const double mass : {3, 1, 4, 1, 5}) {
    impulses.push_back(0.01 * 9.81 * above);
    above -= mass;
  }
  warm_start(impulses, p.rows, p.V);
  expect_near("residual of a stack of five that starts with the impulses of the step before [m/s]",
              "Eq. (10.2)", residual(p.rows, p.V), 0, roundings(100, 1), {},
              "At rest the impulses of the last step are the solution: no sweep is needed.");
}

EXERCISE_TEST(WarmStart, SweepsOfManyStepsAddUp) {
  const int steps = 5, sweeps = 4;
  Problem<3> once = stack({1, 10, 3}, 0.1), now = once;
  solve(once.rows, once.V, {.max_sweeps = steps * sweeps, .tolerance = 0});
  std::vector<double> impulses(3, 0.0);
  for (int step = 0; step < steps; ++step) {
    now = stack({1, 10, 3}, 0.1);
    warm_start(impulses, now.rows, now.V);
    solve(now.rows, now.V, {.max_sweeps = sweeps, .tolerance = 0});
    impulses = as_std(lambdas(now));
  }
  expect_near_vector("λ after 5 steps of 4 sweeps, against 20 sweeps at once; the same rows [N s]",
                     "Eq. (10.2)", lambdas(now), lambdas(once), roundings(200, 10), {},
                     "A step that starts at the result of the last one continues its sweeps.");
}

EXERCISE_TEST(WarmStart, KeepsANaN) {
  Problem<3> p = stack({1, 1}, 0.1);
  warm_start({std::nan(""), 1}, p.rows, p.V);
  expect_true("a λ that was NaN is still NaN", "Eq. (10.2)", std::isnan(p.rows[0].lambda),
              "std::min and std::max turn a NaN into a number; std::clamp keeps it.");
}

EXERCISE_TEST(WarmStart, WantsOneImpulseARow) {
  Problem<3> p = stack({1, 1}, 0.1);
  warm_start({1, 1}, p.rows, p.V);
  const std::string other_rows =
      "Too many are as wrong as too few: they belong to other rows. Compare the sizes first.";
  // The case with too many comes first: without a check the other reads beyond the end of the list and may crash.
  expect_rejects(
      "three impulses for two rows", "impulses",
      [&] {
        warm_start({1, 1, 1}, p.rows, p.V);
      },
      other_rows, state_of(p.rows, p.V));
  expect_rejects(
      "one impulse for two rows", "impulses", [&] { warm_start({1}, p.rows, p.V); }, other_rows,
      state_of(p.rows, p.V));
  std::vector<Row<3>> none;
  warm_start({}, none, p.V);
  expect_near("V of a warm start without rows [m/s]", "Eq. (10.2)", flat(p.V).norm(), 0, {0, "exact"}, {},
              "V is the effect of the rows: without rows 0.");
}

EXERCISE_TEST(WarmStart, DropsNothingSmall) {
  for (const double part : relative_scales) {
    Problem<3> p = stack({1, 1}, 0.1);
    warm_start({1, part}, p.rows, p.V);
    expect_near("λ that was " + show(part) + " N s, beside one of 1 N s [N s]", "Eq. (10.2)", p.rows[1].lambda,
                part, {0, "a copy"}, {{0, "It starts with 0. " + small_is_dropped}}, small_is_dropped);
    if (::testing::Test::HasFailure()) return;
  }
}

}  // namespace
