// interior_solve against enumerated solutions, on hard rows, and where there is no solution.
#include <algorithm>

#include "algebra.hpp"
#include "exercise_test.hpp"
#include "stop_rule.hpp"
#include "systems.hpp"

using namespace spook;
using namespace spook::testing;

namespace {

EXERCISE(InteriorSolve, "11.10 interior_solve");

struct Solved {
  SolveReport report;
  Vector lambda;
  Factors factors;
};

void solve_bounded(const Bounded& p, const StopRule& stop, Solved& solved) {
  if (solved.lambda.size() == 0) solved.lambda = Vector::Zero(p.B.size());
  solved.report = interior_solve(lower_triangle(p.S), p.B, p.lo, p.hi, stop, solved.lambda, solved.factors);
}

void expect_solved(const std::string& what, const Solved& solved) {
  expect_true(what + " is solved", "Eq. (11.13)", solved.report.converged,
              (solved.report.trouble.empty() ? "" : "It reports: " + solved.report.trouble + ". ") +
                  "With a tolerance of 0 it is solved when only the round-off of Eq. (11.13) is left: further "
                  "steps divide by rooms of 0.");
  expect_true(what + " leaves `trouble` empty", "Eq. (11.13)", solved.report.trouble.empty(),
              "`trouble` is for solves that did not converge.");
}

EXERCISE_TEST(InteriorSolve, AgreesWithEveryEnumeratedProblem) {
  Random random;
  for (int rows = 1; rows <= 6; ++rows)
    for (int repeat = 0; repeat < 5; ++repeat) {
      System<6> s = random_system(random, 2 + rows / 2, rows);
      add_random_bounds(random, s.rows);
      const Bounded p = bounded(s.rows);
      Solved solved;
      solve_bounded(p, exact, solved);
      const std::string what = std::to_string(rows) + " rows with bounds";
      Solved again;
      solve_bounded(p, exact, again);
      if (again.report.history != solved.report.history || again.lambda != solved.lambda)
        this_failure_explains();
      expect_true(
          "the result for " + what + " is the same in a second call", "Eq. (11.13)",
          again.report.history == solved.report.history && again.lambda == solved.lambda,
          "A value is kept from one call to the next, in a static or a global variable. The result must "
          "depend on the arguments only.");
      expect_solved(what, solved);
      const VectorXd expected = enumerate_solution(p), free = solution_of(p.S, p.B);
      expect_near_vector(
          "λ of " + what + " [N s]", "Eq. (4.1)", VectorXd(solved.lambda), expected,
          {1e-11 * condition(p.S), "the residual of Eq. (11.13) times the condition of S"},
          {{VectorXd(free.cwiseMax(p.lo).cwiseMin(p.hi)),
            "This is the solution without bounds, clamped. Other rows then need other impulses."},
           {free, "This is the solution without bounds."}},
          "All sets of active bounds were tried; this is the only solution.");
    }
}

EXERCISE_TEST(InteriorSolve, WithoutBoundsIsLinear) {
  Random random;
  for (int repeat = 0; repeat < 10; ++repeat) {
    const Bounded p = bounded(random_system(random, 6, 15).rows);
    Solved solved;
    solve_bounded(p, exact, solved);
    expect_solved("a system without bounds", solved);
    expect_at_most("factorisations for rows without bounds", "Eq. (11.5)",
                   static_cast<double>(solved.report.history.size()), 2,
                   "one step is the solution, and one to spare",
                   "interior_step takes the whole step if no bound limits it.");
    const VectorXd expected = solution_of(p.S, p.B);
    expect_near_vector("λ of 15 rows without bounds [N s]", "Eq. (11.5)", VectorXd(solved.lambda), expected,
                       {1e-11 * condition(p.S), "the residual of Eq. (11.13) times the condition of S"});
  }
}

EXERCISE_TEST(InteriorSolve, SolvesManyRows) {
  Random random;
  for (int repeat = 0; repeat < 3; ++repeat) {
    System<6> s = random_system(random, 40, 120);
    add_random_bounds(random, s.rows);
    const Bounded p = bounded(s.rows);
    Solved solved;
    solve_bounded(p, exact, solved);
    expect_solved("a system of 120 rows with bounds", solved);
    expect_at_most("residual, with all zeros of S written down [m/s]", "Eq. (4.8)",
                   dense_residual(p, solved.lambda), 1e-11, "round-off of 120 rows");
    // 3^120 sets of bounds could be active; ours takes about 12 factorisations.
    expect_at_most("factorisations", "Eq. (11.11)", static_cast<double>(solved.report.history.size()), 24,
                   "twice as many as are needed",
                   "One factorisation a step: from interior_start, by interior_step.");
  }
}

EXERCISE_TEST(InteriorSolve, LooksForThePatternOnce) {
  Random random;
  System<6> s = random_system(random, 10, 20);
  add_random_bounds(random, s.rows);
  Solved solved;
  solve_bounded(bounded(s.rows), exact, solved);
  expect_near("analyses for one system", "Eq. (11.7)", solved.factors.analyses, 1,
              {0, "S̃ has the pattern of S"},
              {{0, "The caller's `factors` were not used: they keep the pattern for the next step."}});
  for (Row<6>& row : s.rows) row.B *= -0.7;
  solve_bounded(bounded(s.rows), exact, solved);
  expect_near("analyses for two systems of one pattern", "Eq. (11.7)", solved.factors.analyses, 1,
              {0, "the pattern is that of the system before"}, {},
              "Use what `factors` hold on entry: a wire keeps its pattern from step to step.");
}

// Contacts on a column of point masses: λ_k = h g times the mass above.
Bounded column(const std::vector<double>& masses, double hg) {
  const Eigen::Index n = std::ssize(masses);
  Bounded p{.S = MatrixXd::Zero(n, n),
            .B = VectorXd::Zero(n),
            .lo = VectorXd::Zero(n),
            .hi = VectorXd::Constant(n, infinity)};
  p.B[0] = hg;
  for (Eigen::Index k = 0; k < n; ++k) {
    const double below = k > 0 ? 1 / masses[k - 1] : 0;
    p.S(k, k) = below + 1 / masses[k];
    if (k > 0) p.S(k, k - 1) = p.S(k - 1, k) = -below;
  }
  return p;
}

EXERCISE_TEST(InteriorSolve, CarriesAnyMassRatio) {
  std::size_t factorisations = 0;
  for (const double ratio : {1.0, 1e4, 1e8})
    for (const bool heavy_on_top : {true, false}) {
      const double lower = heavy_on_top ? 1 : ratio, upper = heavy_on_top ? ratio : 1;
      Solved solved;
      const Bounded p = column({lower, upper}, 0.1);
      solve_bounded(p, exact, solved);
      const std::string what = show(upper) + " kg on " + show(lower) + " kg";
      expect_solved(what, solved);
      const double allowed = roundings(lower_triangle(p.S), p.B, solved.lambda);
      expect_at_most("residual [m/s], " + what, "Eq. (4.8)", dense_residual(p, solved.lambda), 1.1 * allowed,
                     "what Eq. (11.13) allows, and round-off of the residual itself",
                     "With a tolerance of 0 only round-off ends it, that of this S, B and λ.");
      expect_near("λ under both, over h g (m + M), " + what, "Eq. (4.1)",
                  solved.lambda[0] / (0.1 * (lower + upper)), 1,
                  {1e-4, "1e-13 times a ratio of up to 1e8, and some more"});
      expect_near("λ between them, over h g M, " + what, "Eq. (4.1)", solved.lambda[1] / (0.1 * upper), 1,
                  {1e-4, "1e-13 times a ratio of up to 1e8, and some more"});
      factorisations += solved.report.history.size();
    }
  expect_at_most(
      "factorisations for all six", "Eq. (11.11)", static_cast<double>(factorisations), 75,
      "one and a half times as many as are needed",
      "One factorisation a step: from interior_start, by interior_step. With τ = μ/10 it would take 123.");
  // A load of 1e4 to 1e8 kg on seven others: a residual below the second term of Eq. (11.13) is a matter of luck.
  Random random;
  factorisations = 0;
  for (int repeat = 0; repeat < 20; ++repeat) {
    std::vector<double> masses(7);
    for (double& mass : masses) mass = random.uniform(0.2, 3);
    masses.push_back(random.log_uniform(1e4, 1e8));
    Solved solved;
    solve_bounded(column(masses, 0.1), exact, solved);
    expect_solved(show(masses.back()) + " kg on seven of 0.2 to 3 kg", solved);
    factorisations += solved.report.history.size();
  }
  expect_at_most("factorisations for 20 columns under a load", "Eq. (11.13)",
                 static_cast<double>(factorisations), 320, "one and a half times as many as are needed",
                 "Round-off of S λ is left, too: here it is larger than that of B.");
}

EXERCISE_TEST(InteriorSolve, LetsContactsOpen) {
  Bounded p = column({1, 2, 3, 4}, 0.1);
  p.B[2] = -5;  // the upper two are thrown up
  Solved solved;
  solve_bounded(p, exact, solved);
  expect_solved("a column whose upper half separates", solved);
  const double right[] = {0.1 * 3, 0.1 * 2, 0, 0};
  for (Eigen::Index k = 0; k < 4; ++k)
    expect_near("λ of contact " + std::to_string(k) + " [N s]", "Eq. (4.1)", solved.lambda[k], right[k],
                {1e-11, "the residual of Eq. (11.13) times the condition of S"});
}

EXERCISE_TEST(InteriorSolve, SharesAmongRowsThatAreTheSame) {
  // 8 friction rows hold 3 degrees of freedom. Apart from a Σ of 1e-10, S is singular.
  Random random;
  for (int repeat = 0; repeat < 10; ++repeat) {
    const MatrixXd G = MatrixXd::NullaryExpr(8, 3, [&] { return random.uniform(-1, 1); });
    const VectorXd slip = VectorXd::NullaryExpr(3, [&] { return random.uniform(-1, 1); });
    const VectorXd bound = VectorXd::NullaryExpr(8, [&] { return random.uniform(0.01, 0.2); });
    const Bounded p{
        .S = G * G.transpose() + 1e-10 * MatrixXd::Identity(8, 8), .B = G * slip, .lo = -bound, .hi = bound};
    Solved solved;
    solve_bounded(p, exact, solved);
    expect_solved("a box that 8 friction rows hold", solved);
    expect_at_most("residual [m/s]", "Eq. (4.8)", dense_residual(p, solved.lambda), 1e-12,
                   "round-off of 8 rows");
  }
  const int n = 50;
  const Bounded p{.S = MatrixXd::Ones(n, n) + 1e-6 * MatrixXd::Identity(n, n),
                  .B = VectorXd::Ones(n),
                  .lo = VectorXd::Zero(n),
                  .hi = VectorXd::Constant(n, infinity)};
  Solved solved;
  solve_bounded(p, exact, solved);
  expect_solved("a body on 50 equal contacts", solved);
  for (Eigen::Index k = 0; k < n; ++k)
    expect_near("λ of each of 50 equal contacts, times 50", "Eq. (11.1)", n * solved.lambda[k],
                1 / (1 + 1e-6 / n), {1e-4, "1e-13 over Σ, times 50 rows, and some more"}, {},
                "With Σ > 0 the solution is unique, and even.");
}

EXERCISE_TEST(InteriorSolve, TakesBoundsNarrowAndWide) {
  Random random;
  for (int repeat = 0; repeat < 20; ++repeat) {
    System<6> s = random_system(random, 4, 5);
    for (Row<6>& row : s.rows) {
      row.lo = repeat % 2 ? -random.log_uniform(1e-6, 10) : random.uniform(-0.2, 0.2);
      row.hi = repeat % 2 ? random.log_uniform(1e-6, 10) : row.lo + random.log_uniform(1e-9, 1e6);
    }
    const Bounded p = bounded(s.rows);
    Solved solved;
    solve_bounded(p, exact, solved);
    expect_solved("a system with bounds between 1e-9 and 1e6 apart", solved);
    expect_near_vector("λ [N s]", "Eq. (4.1)", VectorXd(solved.lambda), enumerate_solution(p),
                       {1e-11 * condition(p.S), "the residual of Eq. (11.13) times the condition of S"});
  }
}

EXERCISE_TEST(InteriorSolve, TakesBoundsThatAreFarAway) {
  Random random;
  for (int repeat = 0; repeat < 10; ++repeat) {
    System<6> s = random_system(random, 4, 5);
    s.rows[0].lo = 0, s.rows[0].hi = infinity;  // a contact beside motors of any strength
    const Bounded without = bounded(s.rows);
    const VectorXd expected = enumerate_solution(without);
    for (const double far : {1e3, 1e9, 1e17}) {
      for (int k = 1; k < 5; ++k) s.rows[k].lo = -far, s.rows[k].hi = far;
      Solved solved;
      solve_bounded(bounded(s.rows), {.max_sweeps = 30, .tolerance = 0}, solved);
      expect_solved("a system with bounds of ±" + show(far) + " N s that hold nothing, in 30 factorisations,",
                    solved);
      expect_near_vector(
          "λ [N s]", "Eq. (4.1)", VectorXd(solved.lambda), expected,
          {1e-11 * condition(without.S), "the residual of Eq. (11.13) times the condition of S"});
    }
  }
}

EXERCISE_TEST(InteriorSolve, TakesAnyGuess) {
  Random random;
  System<6> s = random_system(random, 6, 12);
  add_random_bounds(random, s.rows);
  const Bounded p = bounded(s.rows);
  Solved cold;
  solve_bounded(p, exact, cold);
  for (const double size : {1e-6, 1.0, 1e4}) {
    Solved guessed;
    guessed.lambda = VectorXd::NullaryExpr(12, [&] { return size * random.uniform(-1, 1); });
    solve_bounded(p, exact, guessed);
    expect_true("from a guess of size " + show(size) + " is solved, without trouble", "Eq. (11.13)",
                guessed.report.converged && guessed.report.trouble.empty(),
                "A guess only tells interior_start a size: do not compute rooms and pushes from it.");
    expect_near_vector("λ from a guess of size " + show(size) + " [N s]", "Eq. (4.1)", guessed.lambda,
                       cold.lambda,
                       {1e-11 * condition(p.S), "the residual of Eq. (11.13) times the condition of S"}, {},
                       "A guess may be outside the bounds. It only tells interior_start a size.");
  }
  // B suggests 0.1 m/s between bodies of 1 kg, and does not show the ton above.
  const Bounded loaded = column({1, 1e3}, 0.1);
  Solved first, again;
  solve_bounded(loaded, exact, first);
  again.lambda = first.lambda;
  solve_bounded(loaded, exact, again);
  expect_true("a ton on 1 kg takes fewer factorisations if the guess is its solution than if it is 0",
              "Eq. (11.12)", again.report.history.size() < first.report.history.size(),
              "Hand the guess to interior_start: it tells the size of λ, where B does not.");
}

EXERCISE_TEST(InteriorSolve, StaysWithinTheBounds) {
  Random random;
  for (const int sweeps : {1, 2, 4, 100}) {
    System<6> s = random_system(random, 10, 25);
    for (Row<6>& row : s.rows) row.lo = random.uniform(-0.3, 0), row.hi = random.uniform(0.01, 0.3);
    const Bounded p = bounded(s.rows);
    Solved solved;
    solve_bounded(p, {.max_sweeps = sweeps, .tolerance = 0}, solved);
    const std::string what = ", after at most " + std::to_string(sweeps) + " factorisations [N s]";
    for (Eigen::Index k = 0; k < 25; ++k) {
      expect_at_least("λ" + what, "Eq. (4.1)", solved.lambda[k], p.lo[k], "its bound below",
                      "The result is within the bounds to the last digit: clamp it.");
      expect_at_most("λ" + what, "Eq. (4.1)", solved.lambda[k], p.hi[k], "its bound above",
                     "The result is within the bounds to the last digit: clamp it.");
    }
  }
}

EXERCISE_TEST(InteriorSolve, SaysWhenItStopsEarly) {
  Random random;
  System<6> s = random_system(random, 12, 30);
  add_random_bounds(random, s.rows);
  Solved solved;
  solve_bounded(bounded(s.rows), {.max_sweeps = 2, .tolerance = 0}, solved);
  expect_near("entries of the history after at most 2 factorisations", "Eq. (4.9)",
              static_cast<double>(solved.report.history.size()), 2, {0, "one a factorisation"});
  expect_true("what is not solved has not converged", "Eq. (11.13)", !solved.report.converged);
  expect_true("`trouble` gives the reason", "Eq. (11.13)", !solved.report.trouble.empty(),
              "Never fail silently: give the reason in `trouble`.");
  Solved whole, nearly;
  solve_bounded(bounded(s.rows), exact, whole);
  const int needed = static_cast<int>(whole.report.history.size());
  if (needed < 2) return expect_true("30 rows with bounds take more than one step", "Eq. (11.13)", false);
  solve_bounded(bounded(s.rows), {.max_sweeps = needed - 1, .tolerance = 0}, nearly);
  expect_true("one factorisation less than needed does not suffice", "Eq. (11.13)",
              !nearly.report.converged && !nearly.report.trouble.empty(),
              "A tolerance of 0 means round-off: a small residual is not enough.");
}

EXERCISE_TEST(InteriorSolve, StopsByTheRule) {
  Random random;
  for (const double size :
       {1e-3, 1.0, 1e3}) {  // of B and the bounds: the tolerance is a velocity, not a fraction of it
    System<6> s = random_system(random, 8, 20);
    add_random_bounds(random, s.rows);
    Bounded p = bounded(s.rows);
    p.B *= size, p.lo *= size, p.hi *= size;
    const auto anew = [&](const StopRule& stop) {
      Solved solved;
      solve_bounded(p, stop, solved);
      return solved.report;
    };
    if (!expect_stops_by_the_rule("Eq. (4.9)", 50, anew)) return;
  }
}

EXERCISE_TEST(InteriorSolve, StopsAtTheTolerance) {
  Random random;
  System<6> s = random_system(random, 12, 30);
  add_random_bounds(random, s.rows);
  const Bounded p = bounded(s.rows);
  Solved coarse, fine;
  solve_bounded(p, {.max_sweeps = 100, .tolerance = 1e-3}, coarse);
  solve_bounded(p, exact, fine);
  expect_solved("a system, to 1e-3 m/s", coarse);
  expect_at_most("residual of a solve to 1e-3 m/s", "Eq. (4.8)", dense_residual(p, coarse.lambda), 1e-3,
                 "the tolerance");
  expect_true("to 1e-3 m/s takes fewer factorisations than to round-off", "Eq. (4.9)",
              coarse.report.history.size() < fine.report.history.size(),
              "Is the tolerance compared with the residual?");
  Solved same;
  solve_bounded(p, {.max_sweeps = 100, .tolerance = coarse.report.history.back()}, same);
  expect_near("factorisations to a tolerance that is the residual of the last of them", "Eq. (4.9)",
              static_cast<double>(same.report.history.size()),
              static_cast<double>(coarse.report.history.size()), {0, "a count"}, {},
              "A residual equal to the tolerance suffices: at most, not below.");
  Solved any;
  solve_bounded(p, {.max_sweeps = 100, .tolerance = 1e9}, any);
  expect_solved("a system, to 1e9 m/s,", any);
  expect_at_most("factorisations to 1e9 m/s", "Eq. (4.9)", static_cast<double>(any.report.history.size()), 1,
                 "the first suffices", "Look at the residual after each of them, the first as well.");
  Solved tiny;
  solve_bounded(p, {.max_sweeps = 100, .tolerance = 1e-300}, tiny);
  expect_solved("a system, to 1e-300 m/s,", tiny);
  expect_near("factorisations to 1e-300 m/s, which is less than round-off", "Eq. (11.13)",
              static_cast<double>(tiny.report.history.size()), static_cast<double>(fine.report.history.size()),
              {0, "a count, and the same as for 0"}, {},
              "Stop at the larger of the tolerance and the round-off.");
}

EXERCISE_TEST(InteriorSolve, RemembersTheResiduals) {
  Random random;
  System<6> s = random_system(random, 8, 16);
  add_random_bounds(random, s.rows);
  const Bounded p = bounded(s.rows);
  Solved solved;
  solve_bounded(p, exact, solved);
  expect_solved("a system of 16 rows", solved);
  if (solved.report.history.empty()) return expect_true("there is a history", "Eq. (4.8)", false);
  expect_near("the last entry of the history [m/s]", "Eq. (4.8)", solved.report.history.back(),
              dense_residual(p, solved.lambda), {1e-12, "roundings"}, {},
              "An entry is the residual of the λ that would be returned, clamped.");
  // The order of the residuals is free. But where twelve contacts disagree about three degrees of freedom, in eight
  // cases of ten some step makes the residual larger before it decreases.
  for (int repeat = 0; repeat < 10; ++repeat) {
    const MatrixXd G = MatrixXd::NullaryExpr(12, 3, [&] { return random.uniform(-1, 1); });
    const Bounded q{.S = G * G.transpose() + 1e-5 * MatrixXd::Identity(12, 12),
                    .B = VectorXd::NullaryExpr(12, [&] { return random.uniform(-1, 1); }),
                    .lo = VectorXd::Zero(12),
                    .hi = VectorXd::Constant(12, infinity)};
    const double at_guess = dense_residual(q, VectorXd::Zero(12));
    for (int sweeps = 1; sweeps <= 40; ++sweeps) {
      Solved early;
      solve_bounded(q, {.max_sweeps = sweeps, .tolerance = 0}, early);
      if (early.report.history.empty()) continue;
      const std::vector<double>& history = early.report.history;
      const double got = dense_residual(q, early.lambda);
      const double least = *std::min_element(history.begin(), history.end());
      const double sums = (q.S.cwiseAbs() * early.lambda.cwiseAbs()).maxCoeff() + 1;
      const Tolerance roundings_of_sums{16 * std::numeric_limits<double>::epsilon() * sums,
                                        "round-off of twelve products and B, added in any order, twice"};
      // A solver that also tests the guess, and finds nothing better, may return the guess.
      const bool kept_guess = at_guess <= least && std::abs(got - at_guess) <= roundings_of_sums.value;
      expect_near("residual of the result after at most " + std::to_string(sweeps) +
                      " factorisations, and the least of the history [m/s]",
                  "Eq. (4.8)", got, kept_guess ? at_guess : least, roundings_of_sums,
                  {{early.report.history.back(), "This is the last λ, not the best."}},
                  got < least ? "The result is better than every entry of the history. Are these the residuals "
                                "of Eq. (4.8), that is, of the row with the largest one?"
                              : "Return the best λ of all factorisations.");
      if (sweeps == 40) expect_solved("a system of contacts that disagree, Σ = 1e-5", early);
    }
  }
  // One row some times over, with Σ = 0 and bounds far away. Their barrier parts the rows, until round-off hides it:
  // then a later factorisation fails, but not by every order of operations.
  for (const double far : {3e3, 5e3})
    for (Eigen::Index n = 3; n <= 5; ++n) {
      const Bounded q{.S = MatrixXd::Ones(n, n),
                      .B = VectorXd::Ones(n),
                      .lo = VectorXd::Constant(n, -far),
                      .hi = VectorXd::Constant(n, 1e3 * far)};
      Solved early;
      solve_bounded(q, exact, early);
      const std::vector<double>& history = early.report.history;
      if (early.report.converged || history.empty()) continue;
      expect_near("residual of the result where factorisation " + std::to_string(history.size() + 1) +
                      " fails, and the least of the history [m/s]",
                  "Eq. (4.8)", dense_residual(q, early.lambda),
                  *std::min_element(history.begin(), history.end()),
                  {16 * std::numeric_limits<double>::epsilon() * (early.lambda.cwiseAbs().sum() + 1),
                   "round-off of five products and B, added in any order, twice"},
                  {{dense_residual(q, VectorXd::Zero(n)),
                    "This is the guess. It is returned only if the first factorisation fails: later ones leave "
                    "the best λ so far."}},
                  "A factorisation that fails leaves the best λ of those before it.");
    }
}

EXERCISE_TEST(InteriorSolve, EndsWithANaN) {
  Random random;
  for (int kind = 0; kind < 5; ++kind) {
    System<6> s = random_system(random, 4, 5);
    add_random_bounds(random, s.rows);
    s.rows[2].lo = kind & 1 ? 0 : -infinity;
    s.rows[2].hi = kind & 2 ? 1 : infinity;
    Bounded p = bounded(s.rows);
    p.B[2] = std::nan("");
    // A row by itself, with a bound that may replace a NaN: no other row shows that it is unsolved.
    if (kind == 4)
      p = {.S = MatrixXd::Identity(1, 1),
           .B = VectorXd::Constant(1, std::nan("")),
           .lo = VectorXd::Zero(1),
           .hi = VectorXd::Ones(1)};
    Solved solved;
    solve_bounded(p, {.max_sweeps = 30, .tolerance = 1e-6}, solved);
    expect_true(
        "a right side with a NaN has not converged", "Eq. (11.13)", !solved.report.converged,
        "std::max, std::min and Eigen's cwiseMax drop a NaN: a bound takes its place. std::clamp keeps it.");
    expect_true("a right side with a NaN is reported in `trouble`", "Eq. (11.13)",
                !solved.report.trouble.empty());
    expect_true("a right side with a NaN leaves λ within the bounds", "Eq. (4.1)",
                (solved.lambda.array() >= p.lo.array()).all() && (solved.lambda.array() <= p.hi.array()).all(),
                "A residual of NaN is not better than any number, so its λ is not the best. Return the guess, "
                "clamped.");
  }
}

EXERCISE_TEST(InteriorSolve, ReportsWhatHasNoAnswer) {
  Bounded p{.S = MatrixXd::Ones(2, 2),
            .B = VectorXd::Ones(2),
            .lo = VectorXd::Constant(2, -infinity),
            .hi = VectorXd::Constant(2, infinity)};
  p.B[1] = 2;  // contradictory, with Σ = 0
  Solved solved;
  solve_bounded(p, exact, solved);
  expect_true("contradictory rows with Σ = 0 and no bounds have not converged", "Eq. (11.4)",
              !solved.report.converged, "factorise returned false: do not use its factors.");
  expect_true("contradictory rows are reported in `trouble`", "Eq. (11.4)", !solved.report.trouble.empty(),
              "factorise returned false: say so in `trouble`.");
  expect_true("contradictory rows leave λ finite", "Eq. (11.4)", solved.lambda.allFinite(),
              "Do not solve with factors of a failed factorisation.");
  expect_true("contradictory rows leave no NaN in the history", "Eq. (4.8)",
              std::none_of(solved.report.history.begin(), solved.report.history.end(),
                           [](double entry) { return std::isnan(entry); }),
              "A factorisation that fails gives no λ, and so no residual to append.");
  Solved refused, stopped;
  solve_bounded(p, {.max_sweeps = 1, .tolerance = 0}, refused);
  solve_bounded(column({1, 1e4}, 0.1), {.max_sweeps = 1, .tolerance = 0}, stopped);
  expect_true(
      "`trouble` distinguishes a failed factorisation from one that did not suffice", "Eq. (11.4)",
      refused.report.trouble != stopped.report.trouble,
      "Both are reported as: " + refused.report.trouble + ". More factorisations help only with the second.");
  // A third row without shared bodies, which has bounds.
  Bounded q{.S = MatrixXd::Identity(3, 3),
            .B = VectorXd::Ones(3),
            .lo = VectorXd::Constant(3, -infinity),
            .hi = VectorXd::Constant(3, infinity)};
  q.S.topLeftCorner<2, 2>().setOnes();
  q.lo[2] = 1, q.hi[2] = 2;
  for (const double guess : {-5.0, 1.5, 5.0}) {
    Solved early;
    early.lambda = VectorXd::Constant(3, guess);
    solve_bounded(q, exact, early);
    expect_near_vector("λ where the first factorisation fails, from a guess of " + show(guess) + " [N s]",
                       "Eq. (4.1)", early.lambda, Vec3(guess, guess, std::clamp(guess, 1.0, 2.0)), {0, "exact"},
                       {}, "There is no solution: return the guess, within the bounds.");
  }
}

EXERCISE_TEST(InteriorSolve, OfNothingIsDone) {
  const Bounded p{.S = MatrixXd(0, 0), .B = VectorXd(0), .lo = VectorXd(0), .hi = VectorXd(0)};
  Solved solved;
  solve_bounded(p, exact, solved);
  expect_true("no rows: converged, without a factorisation", "Eq. (4.9)",
              solved.report.converged && solved.report.history.empty() && solved.report.trouble.empty());
}

EXERCISE_TEST(InteriorSolve, RejectsARuleThatCannotBeMet) {
  const Bounded p = column({1, 2}, 0.1);
  Solved solved;
  solve_bounded(p, exact, solved);
  for (const int sweeps : {0, -5})
    expect_rejects("max_sweeps = " + std::to_string(sweeps), "max_sweeps",
                   [&] { solve_bounded(p, {.max_sweeps = sweeps, .tolerance = 0}, solved); });
  for (const double tolerance : {-1e-9, std::nan(""), HUGE_VAL})
    expect_rejects("tolerance = " + show(tolerance), "tolerance",
                   [&] { solve_bounded(p, {.max_sweeps = 5, .tolerance = tolerance}, solved); });
  const Bounded none{.S = MatrixXd(0, 0), .B = VectorXd(0), .lo = VectorXd(0), .hi = VectorXd(0)};
  Solved nothing;
  expect_rejects(
      "max_sweeps = 0, with no rows", "max_sweeps",
      [&] { solve_bounded(none, {.max_sweeps = 0, .tolerance = 0}, nothing); },
      "It throws as solve does, with rows or without: check the rule first.");
}

}  // namespace
