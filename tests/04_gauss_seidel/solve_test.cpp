// Sweeps until the tolerance is met: compared with enumerated solutions, and counted.
#include "exercise_test.hpp"
#include "problems.hpp"
#include "regions.hpp"
#include "stop_rule.hpp"

using namespace spook;
using namespace spook::testing;

namespace {

EXERCISE(Solve, "4.6 solve");

void compare_with_enumeration(Problem<6>& p, const std::string& what) {
  const Bounded problem = bounded(p.rows);
  const double tolerance = 1e-13;
  const SolveReport report = solve(p.rows, p.V, {.max_sweeps = 200000, .tolerance = tolerance});
  expect_true("converged within 200000 sweeps", "Eq. (4.9)", report.converged);
  const double n = static_cast<double>(p.rows.size());
  expect_near_vector("λ of " + what + " [N s]", "Eq. (4.1)", gathered(p.rows, &Row<6>::lambda),
                     enumerate_solution(problem),
                     {10 * n * condition(problem.S) * (tolerance + 1e-14), "residual times condition of S"}, {},
                     "The expected λ is the only solution: the test has tried all active sets.");
}

EXERCISE_TEST(Solve, AgreesWithEveryEnumeratedContactProblem) {
  Random random;
  for (int rows = 1; rows <= 8; ++rows)
    for (int repeat = 0; repeat < 5; ++repeat) {
      Problem<6> p = random_problem(random, 2 + rows / 2, rows);
      compare_with_enumeration(p, std::to_string(rows) + " contacts");
    }
}

EXERCISE_TEST(Solve, AgreesWithEveryEnumeratedBoxProblem) {
  Random random;
  for (int rows = 1; rows <= 6; ++rows) {
    Problem<6> p = random_problem(random, 2 + rows / 2, rows);
    for (auto& row : p.rows) {
      row.lo = -random.uniform(0, 0.2);
      row.hi = random.uniform(0, 0.2);
    }
    compare_with_enumeration(p, std::to_string(rows) + " rows with two bounds");
  }
}

double relative_error_after(int sweeps, double lower, double upper) {
  Problem<3> p = stack({lower, upper}, 0.01);
  solve(p.rows, p.V, {.max_sweeps = sweeps, .tolerance = 0});
  const double exact = 0.01 * 9.81 * upper;
  return std::abs(p.rows[1].lambda - exact) / exact;
}

EXERCISE_TEST(Solve, Needs13823SweepsFor1000To1) {
  const double slack = 1e-6 * 1e-8;  // roundings of 13,823 sweeps, against a step of 1e-3 between two sweeps
  expect_at_most("error of λ after 13,823 sweeps, 1 kg under 1000 kg", "Eq. (4.11)",
                 relative_error_after(13823, 1, 1000), 1e-6 + slack, "ln(1e6)/ln(1.001) = 13,822.4 sweeps",
                 "Each sweep divides the error by 1.001. Does V keep its value from one sweep to the next?");
  expect_at_least("error of λ after 13,822 sweeps, 1 kg under 1000 kg", "Eq. (4.11)",
                  relative_error_after(13822, 1, 1000), 1e-6 - slack, "one sweep fewer is not enough",
                  "This is faster than Gauss-Seidel can be. Was a sweep made but not counted?");
}

EXERCISE_TEST(Solve, Needs2SweepsWithTheHeavyBodyBelow) {
  expect_at_most("error of λ after 2 sweeps, 1000 kg under 1 kg", "Eq. (4.11)",
                 relative_error_after(2, 1000, 1), 1e-6, "(1/1001)² < 1e-6");
  expect_at_least("error of λ after 1 sweep, 1000 kg under 1 kg", "Eq. (4.11)",
                  relative_error_after(1, 1000, 1), 9e-4, "1/1001: one sweep is not enough",
                  "max_sweeps = 1 must make one sweep.");
}

EXERCISE_TEST(Solve, CarriesATower) {
  const int n = 10;
  const double h = 0.01, m = 2, g = 9.81;
  Problem<3> p = stack(std::vector<double>(n, m), h);
  const SolveReport report = solve(p.rows, p.V, {.max_sweeps = 100000, .tolerance = 1e-14});
  expect_true("the tower has converged", "Eq. (4.9)", report.converged);
  for (int k = 0; k < n; ++k)
    expect_near("λ under body " + std::to_string(k + 1) + " of 10 [N s]", "Eq. (4.1)",
                p.rows[static_cast<std::size_t>(k)].lambda, h * g * m * (n - k),
                {1e-10, "tolerance 1e-14 times the condition, about 4 n²/π² times the mass, and n rows"}, {},
                "It carries itself and all bodies above it.");
}

EXERCISE_TEST(Solve, ConservesMomentum) {
  Random random;
  Problem<6> p = random_problem(random, 5, 12);
  solve(p.rows, p.V, {.max_sweeps = 100, .tolerance = 0});
  Vec3 momentum = Vec3::Zero();
  for (std::size_t k = 0; k < p.V.size(); ++k) momentum += p.V[k].head<3>() / p.motion.inverse_mass[k].linear;
  expect_near_vector("momentum that 100 sweeps of 12 contacts give 5 free bodies in all [kg m/s]", "Eq. (4.5)",
                     momentum, Vec3::Zero(), roundings(100 * 12 * 4, 5), {},
                     "Every impulse acts on two bodies, before convergence, too.");
}

EXERCISE_TEST(Solve, LetsASeparatingContactGo) {
  Random random;
  for (int repeat = 0; repeat < 50; ++repeat) {
    Problem<6> p = random_problem(random, 4, 8);
    solve(p.rows, p.V, {.max_sweeps = 30, .tolerance = 0});
    for (const auto& row : p.rows)
      expect_at_least("λ of a contact [N s]", "Eq. (4.1)", row.lambda, 0, "contacts never pull");
  }
  Problem<3> p = stack({1, 1}, 0.01);
  p.rows[1].B = -1;  // the upper body is moving up
  solve(p.rows, p.V, {.max_sweeps = 100, .tolerance = 1e-14});
  expect_near("λ under a body that leaves [N s]", "Eq. (4.1)", p.rows[1].lambda, 0, {0, "exact"});
  expect_near("λ under the one that stays [N s]", "Eq. (4.1)", p.rows[0].lambda, 0.01 * 9.81, roundings(16));
}

EXERCISE_TEST(Solve, StopsAtTheFirstSweepThatIsGoodEnough) {
  Problem<3> p = stack({1, 10}, 0.1);
  const SolveReport report = solve(p.rows, p.V, {.max_sweeps = 1000, .tolerance = 1e-6});
  const std::size_t n = report.history.size();
  const bool stopped = report.converged && n > 2 && n < 1000;
  expect_true(
      "it converges in 3 to 999 sweeps; here it made " + std::to_string(n), "Eq. (4.9)", stopped,
      "A sweep that returns at most the tolerance is the last one, and `converged` says that there was one.");
  if (!stopped) return;
  expect_at_most("what the last sweep returned [m/s]", "Eq. (4.9)", report.history[n - 1], 1e-6,
                 "the tolerance", "Does the history contain the last sweep, too?");
  expect_at_least("what the sweep before it returned [m/s]", "Eq. (4.9)", report.history[n - 2], 1e-6,
                  "not good enough", "It should have stopped earlier.");
  for (std::size_t k = 2; k < n; ++k)
    expect_near("ratio of what two sweeps returned", "Eq. (4.10)", report.history[k] / report.history[k - 1],
                1 / 1.1, {1e-6, "1e-14 roundings over changes above 1e-7"}, {},
                "The history holds what each sweep returned, in order.");
}

EXERCISE_TEST(Solve, RemembersWhatEachSweepReturned) {
  Problem<3> p = stack({1, 10, 2}, 0.1), by_hand = p;
  const SolveReport report = solve(p.rows, p.V, {.max_sweeps = 4, .tolerance = 0});
  expect_true("four sweeps leave four entries", "Eq. (4.9)", report.history.size() == 4,
              "One entry a sweep, and max_sweeps of them when the tolerance is never met.");
  for (const double got : report.history) {
    const double returned = sweep(by_hand.rows, by_hand.V);
    expect_near("entry of the history [m/s]", "Eq. (4.9)", got, returned, roundings(8, 2),
                {{residual(by_hand.rows, by_hand.V),
                  "This is the residual after the sweep. The rule and the history "
                  "look at what sweep() returned, which costs nothing."}});
  }
}

EXERCISE_TEST(Solve, StopsByTheRule) {
  Random random;
  for (const double size : {1e-3, 1.0, 1e3}) {  // a factor of B: the tolerance is a velocity, and not relative
                                                // to B
    Problem<6> p = random_problem(random, 10, 14);
    // Without bounds, since rows that all have λ = 0 are solved after two sweeps.
    for (Row<6>& row : p.rows) row.B *= size, row.lo = -infinity;
    const auto anew = [&](const StopRule& stop) {
      Problem<6> again = p;
      return solve(again.rows, again.V, stop);
    };
    if (!expect_stops_by_the_rule("Eq. (4.9)", 12, anew)) return;
  }
}

// Bounds and the stop rule together: when rows reach or leave a bound, a sweep may return more than the one
// before.
EXERCISE_TEST(Solve, GoesOnWhenASweepReturnsMore) {
  Random random;
  Regions regions({"a sweep returns more than the one before"}, 20);
  while (regions.lack_draws()) {
    const int bodies = random.integer(3, 8);
    const Problem<6> p = any_rows(random, bodies);
    Problem<6> swept = p;
    std::vector<double> by_hand;
    for (int k = 0; k < 12; ++k) by_hand.push_back(sweep(swept.rows, swept.V));
    const bool more = one_returns_more(by_hand);
    regions.draw({{"a sweep returns more than the one before", more}});
    const auto anew = [&](const StopRule& stop) {
      Problem<6> again = p;
      return solve(again.rows, again.V, stop);
    };
    if (more) expect_goes_on_when_one_returns_more("Eq. (4.9)", by_hand, anew);
  }
}

// V and λ belong together: V = M⁻¹ Gᵀ λ after any number of sweeps.
EXERCISE_TEST(Solve, LeavesVAndLambdaTogether) {
  Random random;
  for (int trial = 0; trial < 10 && !::testing::Test::HasFailure(); ++trial) {
    Problem<6> p = any_rows(random, 5);
    const Eigen::VectorXd before = joined_V(p);
    const int sweeps = random.integer(1, 30);
    const SolveReport report = solve(p.rows, p.V, {.max_sweeps = sweeps, .tolerance = 1e-3});
    expect_true("it made a sweep", "Eq. (4.9)", !report.history.empty());
    Problem<6> again = p;
    set_lambda(again, gathered(p.rows, &Row<6>::lambda));
    expect_near_vector("V of five bodies after a solve, against M⁻¹ Gᵀ λ of the λ that it left", "Eq. (4.5)",
                       joined_V(p), joined_V(again), roundings(20 * 30 * 4, 5),
                       {{before, "V has not changed. Return the V of the last sweep."}},
                       "V = M⁻¹ Gᵀ λ, after any number of sweeps.");
  }
}

// In a stack that is swept from the top down, the ground's effect rises one row a sweep, so the first sweeps
// all return the same.
EXERCISE_TEST(Solve, GoesOnWhenTwoSweepsReturnTheSame) {
  Problem<3> p = stack({1, 1, 1, 1, 1, 1}, 0.1);
  std::reverse(p.rows.begin(), p.rows.end());
  Problem<3> again = p;
  for (int k = 0; k < 40; ++k) sweep(again.rows, again.V);
  const SolveReport report = solve(p.rows, p.V, {.max_sweeps = 40, .tolerance = 0});
  expect_near("sweeps of a stack of six, from the top down, of 40 that are allowed", "Eq. (4.9)",
              static_cast<double>(report.history.size()), 40, {0, "a count"}, {},
              "The first sweeps all return the same, since the ground's effect rises one row a sweep. Equal "
              "values are no reason to stop: only the tolerance and max_sweeps end the solve.");
  expect_near_vector("λ after them [N s]", "Eq. (4.2)", gathered(p.rows, &Row<3>::lambda),
                     gathered(again.rows, &Row<3>::lambda), {0, "the same 40 sweeps"});
}

EXERCISE_TEST(Solve, StopsWhenASweepChangesNothing) {
  Problem<3> p = stack({1}, 0.1);
  const SolveReport report = solve(p.rows, p.V, {.max_sweeps = 50, .tolerance = 0});
  expect_true("one row, tolerance 0: solved in sweep 1, seen in sweep 2", "Eq. (4.9)",
              report.converged && report.history.size() == 2,
              "Stop when the value is at most the tolerance, as 0 <= 0. With < a solved system takes all "
              "max_sweeps in every step.");
  const SolveReport again = solve(p.rows, p.V, {.max_sweeps = 50, .tolerance = 0});
  expect_true(
      "the same row, solved before: seen in sweep 1", "Eq. (4.9)", again.converged && again.history.size() == 1,
      again.history.empty()
          ? "No sweep has been made. What a sweep returns tells whether the rows are solved, so make one."
          : "The first sweep may return at most the tolerance, too, and then it is the last.");
}

EXERCISE_TEST(Solve, DoesNotTakeANaNForConverged) {
  Problem<3> p = stack({1, 1}, 0.1);
  p.rows[0].B = std::nan("");
  const SolveReport report = solve(p.rows, p.V, {.max_sweeps = 5, .tolerance = 1e-6});
  expect_true("a solve of NaN has not converged", "Eq. (4.9)", !report.converged,
              "Every comparison with NaN is false. Test for <= the tolerance, not for the opposite of >.");
}

EXERCISE_TEST(Solve, StopsAtMaxSweeps) {
  Problem<3> p = stack({1, 1000}, 0.1);
  const SolveReport report = solve(p.rows, p.V, {.max_sweeps = 7, .tolerance = 1e-12});
  expect_near("sweeps made, of at most 7", "Eq. (4.9)", static_cast<double>(report.history.size()), 7,
              {0, "a count"});
  expect_true("a solve that ran out of sweeps says so", "Eq. (4.9)", !report.converged,
              "`converged` is true if the last sweep returned at most the tolerance.");
}

EXERCISE_TEST(Solve, GoesOnWhereItStopped) {
  Problem<3> p = stack({1, 10, 3}, 0.1), once = p;
  solve(once.rows, once.V, {.max_sweeps = 20, .tolerance = 0});
  solve(p.rows, p.V, {.max_sweeps = 8, .tolerance = 0});
  solve(p.rows, p.V, {.max_sweeps = 12, .tolerance = 0});
  expect_near_vector("λ after 8 and 12 sweeps, against 20 at once [N s]", "Eq. (4.2)",
                     gathered(p.rows, &Row<3>::lambda), gathered(once.rows, &Row<3>::lambda), roundings(20, 10),
                     {}, "λ and V on entry are a warm start: neither is set to zero.");
}

EXERCISE_TEST(Solve, OfNothingIsDone) {
  std::vector<Row<6>> none;
  std::vector<Twist<6>> V;
  const SolveReport report = solve(none, V, {});
  expect_true("no rows: converged, without a sweep", "Eq. (4.9)", report.converged && report.history.empty(),
              "Without rows nothing is left to do: converged is true and the history empty.");
}

EXERCISE_TEST(Solve, RejectsARuleThatCannotBeMet) {
  Problem<3> p = stack({1}, 0.1);
  solve(p.rows, p.V, {.max_sweeps = 1, .tolerance = 0});
  p = stack({1}, 0.1);
  const auto state = state_of(p.rows, p.V);
  for (const int sweeps : {0, -5})
    expect_rejects(
        "max_sweeps = " + std::to_string(sweeps), "max_sweeps",
        [&] { solve(p.rows, p.V, {.max_sweeps = sweeps, .tolerance = 0}); }, "", state);
  for (const double tolerance : {-1e-9, std::nan(""), HUGE_VAL})
    expect_rejects(
        "tolerance = " + show(tolerance), "tolerance",
        [&] { solve(p.rows, p.V, {.max_sweeps = 5, .tolerance = tolerance}); }, "", state);
  std::vector<Row<3>> none;
  expect_rejects(
      "max_sweeps = 0, with no rows", "max_sweeps",
      [&] { solve(none, p.V, {.max_sweeps = 0, .tolerance = 0}); },
      "Check the rule first: one that makes no sense is refused even if there are no rows.");
}

}  // namespace
