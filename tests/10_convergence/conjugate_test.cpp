// Conjugate gradients: the preconditioner and the solver.
#include "algebra.hpp"
#include "exercise_test.hpp"
#include "random_input.hpp"
#include "relative_scales.hpp"
#include "stop_rule.hpp"
#include "systems.hpp"

using namespace spook;
using namespace spook::testing;

namespace {

EXERCISE(Precondition, "10.7 precondition");
EXERCISE(ConjugateSolve, "10.8 conjugate_solve");

std::vector<bool> all_free(std::size_t n) {
  return std::vector<bool>(n, true);
}

Eigen::VectorXd random_values(Random& random, Eigen::Index n) {
  Eigen::VectorXd values(n);
  for (double& value : values) value = random.uniform(-1, 1);
  return values;
}

Eigen::VectorXd forth(const Eigen::MatrixXd& S, const Eigen::VectorXd& r) {
  return S.triangularView<Eigen::Lower>().solve(r);
}

Eigen::VectorXd forth_and_back(const Eigen::MatrixXd& S, const Eigen::VectorXd& r) {
  const Eigen::VectorXd z = forth(S, r);
  return z + S.triangularView<Eigen::Upper>().solve(r - S * z);
}

EXERCISE_TEST(Precondition, SweepsForthAndBack) {
  Random random;
  Problem<6> p = random_problem(random, 3, 6);
  set_lambda(p, Eigen::VectorXd::Constant(6, 0.3));  // irrelevant here, as are B and the bounds
  for (Row<6>& row : p.rows) row.hi = 0.31;
  const Eigen::VectorXd r = random_values(random, 6);
  const auto z = precondition(p.rows, as_std(r), all_free(6), p.V.size());
  expect_true("one z for each of six rows", "Eq. (10.6)", z.size() == 6);
  if (z.size() != 6) return;
  const Eigen::MatrixXd S = dense_S(p.rows);
  Eigen::MatrixXd without_Sigma = S;
  for (Eigen::Index k = 0; k < 6; ++k) without_Sigma(k, k) -= p.rows[static_cast<std::size_t>(k)].Sigma;
  const Eigen::VectorXd D = S.diagonal(), once = forth(S, r), B = gathered(p.rows, &Row<6>::B);
  const Eigen::VectorXd back_first = [&] {
    const Eigen::VectorXd first = S.triangularView<Eigen::Upper>().solve(r);
    return Eigen::VectorXd(first + forth(S, r - S * first));
  }();
  Eigen::VectorXd not_to_the_end = forth_and_back(S, r);
  not_to_the_end[0] = once[0];
  const Eigen::VectorXd forgetful = once + S.triangularView<Eigen::Upper>().solve(r - without_Sigma * once);
  expect_near_vector(
      "z of six coupled rows [N s]", "Eq. (10.6)", as_eigen(z), forth_and_back(S, r), roundings(1000, 10),
      {{once, "This is one sweep, first to last. Sweep back from the last row to the first afterwards."},
       {once + forth(S, r - S * once), "These are two sweeps from first to last: the second goes back."},
       {not_to_the_end, "The way back ends before the first row. It updates that one, too."},
       {back_first, "This swept back first, and forth afterwards."},
       {r.cwiseQuotient(D), "This is r/S_kk alone: each row must use the updates of the rows before it."},
       {forth_and_back(S, B), "The right side is r, not the rows' B."},
       {forgetful, "Σ z is missing in a row's residual: r - G V - Σ z."}},
      "Start at z = 0 and V = 0. For each row compute r - G V - Σ z, add that divided by S_kk to z, and "
      "scatter the change.");
}

EXERCISE_TEST(Precondition, SweepsAnyNumberOfBodies) {
  Random random;
  for (const auto& [bodies, rows] : {std::pair(2, 12), {9, 12}, {30, 12}, {30, many}}) {
    const Problem<6> p = random_problem(random, bodies, rows);
    const Eigen::MatrixXd S = dense_S(p.rows);
    Eigen::VectorXd r(rows);
    for (double& each : r) each = random.uniform(-1, 1);
    // Sweeps forth and back from zero: (D + U)⁻¹ D (D + L)⁻¹ r.
    const Eigen::VectorXd forth = S.triangularView<Eigen::Lower>().solve(r);
    const Eigen::VectorXd both = S.triangularView<Eigen::Upper>().solve(S.diagonal().cwiseProduct(forth));
    const auto z = precondition(p.rows, as_std(r), all_free(p.rows.size()), p.V.size());
    expect_near_vector(
        "z of " + std::to_string(rows) + " rows between " + std::to_string(bodies) + " bodies [N s]",
        "Eq. (10.6)", as_eigen(z), both, roundings(1e4, 10), {{forth, "This is the forward sweep alone."}},
        "Sweep all rows, once first to last and once last to first. " + ends_early);
  }
}

/// Two rows with S_kk = 3/kg that share a body. After a sweep B - G V of the first row is a small part of its Σ λ: two
/// large numbers all but cancel.
Problem<3> cancelling_problem(double part) {
  Problem<3> p;
  p.V.assign(3, Twist<3>::Zero());
  const Twist<3> up(0, 0, 1);
  for (int k = 0; k < 2; ++k)
    p.rows.push_back({.i = k,
                      .j = k + 1,
                      .Gi = -up,
                      .Gj = up,
                      .MinvGi = -up,
                      .MinvGj = up,
                      .B = 0,
                      .Sigma = 1,
                      .diagonal = 3,
                      .lo = -infinity,
                      .hi = infinity});
  // λ1 = B1/3 and λ2 = (B2 + λ1)/3; B1 - G V = B1 - 2 λ1 + λ2 = λ1 + λ2.
  const double first = 0.7, second = first * (part - 1);
  p.rows[0].B = 3 * first;
  p.rows[1].B = 3 * second - first;
  return p;
}

/// Three rows around three bodies, some of them so heavy that they hardly move. B = 1 m/s or a fraction of that. All
/// such systems are tried, some with a small Σ, and one with terms that all but cancel. S stays well conditioned.
std::vector<Problem<3>> unlike_problems(double part) {
  const Twist<3> up(0, 0, 1);
  std::vector<Problem<3>> all;
  for (int bits = 0; bits < 64; ++bits) {
    const auto size = [&](int bit) { return bits >> bit & 1 ? part : 1; };
    Problem<3> p;
    p.V.assign(3, Twist<3>::Zero());
    for (int k = 0; k < 3; ++k) {
      const int i = k, j = (k + 1) % 3;
      p.rows.push_back({.i = i,
                        .j = j,
                        .Gi = -up,
                        .Gj = up,
                        .MinvGi = -size(i) * up,
                        .MinvGj = size(j) * up,
                        .B = size(3 + k),
                        .Sigma = 1,
                        .diagonal = size(i) + size(j) + 1,
                        .lo = -infinity,
                        .hi = infinity});
    }
    all.push_back(p);
    if (bits % 8 == 0) {  // if all bodies are light, Σ of one row may be small, too
      p.rows[2].Sigma = part, p.rows[2].diagonal = 2 + part;
      all.push_back(p);
    }
  }
  all.push_back(cancelling_problem(part));
  return all;
}

EXERCISE_TEST(Precondition, DropsNothingSmall) {
  for (const double part : relative_scales)
    for (const Problem<3>& p : unlike_problems(part)) {
      const Eigen::MatrixXd S = dense_S(p.rows);
      const Eigen::VectorXd r = gathered(p.rows, &Row<3>::B);
      const auto z = precondition(p.rows, as_std(r), all_free(p.rows.size()), 3);
      expect_near_vector("z of some rows, for r = " + show(Eigen::MatrixXd(r)) +
                             " m/s and S_kk = " + show(Eigen::MatrixXd(S.diagonal())) + " /kg [N s]",
                         "Eq. (10.6)", as_eigen(z), forth_and_back(S, r), roundings(32), {}, small_is_dropped);
      if (::testing::Test::HasFailure()) return;
    }
}

EXERCISE_TEST(Precondition, KnowsNoBounds) {
  Problem<3> p = stack({1, 1}, 0.1);
  const Eigen::Vector2d r(-1, -3);
  const auto z = precondition(p.rows, as_std(r), all_free(2), p.V.size());
  const Eigen::MatrixXd S = dense_S(p.rows);
  const Eigen::Vector2d up =
      -r;  // λ = 0 is at the lower bound of both rows, but `free` says that they are free
  expect_near_vector("z of two contacts with positive residuals, λ = 0 [N s]", "Eq. (10.6)",
                     as_eigen(precondition(p.rows, as_std(up), all_free(2), p.V.size())), forth_and_back(S, up),
                     roundings(32, 4),
                     {{Eigen::Vector2d(0, 0),
                       "Both rows have been left out. `free` says which rows are free, whatever λ and bounds "
                       "are."}});
  expect_near_vector("z of two contacts with negative residuals [N s]", "Eq. (10.6)", as_eigen(z),
                     forth_and_back(S, r), roundings(32, 4),
                     {{Eigen::Vector2d(0, 0), "z is a direction, and may be negative: it is not projected."}},
                     "z is not projected.");
}

EXERCISE_TEST(Precondition, LeavesTheOthersAlone) {
  Random random;
  const Problem<6> p = random_problem(random, 3, 7);
  const Eigen::VectorXd r = random_values(random, 7);
  const std::vector<bool> free = {true, false, true, true, false, true, false};
  const auto z = precondition(p.rows, as_std(r), free, p.V.size());
  // The same system, of its free rows alone.
  Problem<6> some = p;
  some.rows.clear();
  std::vector<double> some_r;
  for (std::size_t k = 0; k < 7; ++k)
    if (free[k]) {
      some.rows.push_back(p.rows[k]);
      some_r.push_back(r[static_cast<Eigen::Index>(k)]);
    }
  const Eigen::MatrixXd S = dense_S(some.rows);
  const Eigen::VectorXd expected_some = forth_and_back(S, as_eigen(some_r));
  Eigen::VectorXd expected = Eigen::VectorXd::Zero(7);
  Eigen::Index next = 0;
  for (Eigen::Index k = 0; k < 7; ++k)
    if (free[static_cast<std::size_t>(k)]) expected[k] = expected_some[next++];
  const Eigen::MatrixXd whole = dense_S(p.rows);
  const auto swept = [&](Eigen::VectorXd x, bool back, bool skips) {
    for (Eigen::Index n = 0; n < 7; ++n) {
      const Eigen::Index k = back ? 6 - n : n;
      if (!skips || free[static_cast<std::size_t>(k)]) x[k] += (r[k] - whole.row(k).dot(x)) / whole(k, k);
    }
    return x;
  };
  const Eigen::VectorXd none = Eigen::VectorXd::Zero(7);
  expect_true("a second call gives the same z", "Eq. (10.6)",
              precondition(p.rows, as_std(r), free, p.V.size()) == z,
              "A value is kept from call to call. In each call both V and z start at zero.");
  expect_near_vector(
      "z of seven rows, of which 1, 4 and 6 are not free [N s]", "Eq. (10.6)", as_eigen(z), expected,
      roundings(1000, 10),
      {{forth_and_back(whole, r), "All rows were treated as free."},
       {swept(swept(none, false, true), true, false),
        "Rows that are not free are skipped on the way forth, but not on the way back."},
       {swept(swept(none, false, false), true, true),
        "Rows that are not free are skipped on the way back, but not on the way forth."},
       {swept(none, false, false), "All rows were treated as free, and the sweep back is missing."}},
      "Skip a row that is not free: z = 0, and nothing is scattered, whatever its r.");
  std::vector<double> strange = as_std(r);
  for (std::size_t k = 0; k < 7; ++k)
    if (!free[k]) strange[k] = std::nan("");
  expect_near_vector("z of the same rows, with r = NaN where they are not free [N s]", "Eq. (10.6)",
                     as_eigen(precondition(p.rows, strange, free, p.V.size())), expected, roundings(1000, 10),
                     {}, "z of a row that is not free is 0 for any r. 0 times NaN is NaN: do not use its r.");
}

EXERCISE_TEST(Precondition, IsSymmetricAndPositive) {
  Random random;
  const Problem<6> p = random_problem(random, 4, 9);
  const Eigen::VectorXd u = random_values(random, 9), v = random_values(random, 9);
  const auto P = [&](const Eigen::VectorXd& r) {
    return as_eigen(precondition(p.rows, as_std(r), all_free(9), p.V.size()));
  };
  expect_near("u·P(v) against v·P(u), where P maps r to z [m N]", "Eq. (10.6)", u.dot(P(v)), v.dot(P(u)),
              roundings(1000, 10), {},
              "Conjugate directions need a symmetric P. One sweep alone is not symmetric: add the sweep back.");
  expect_at_least("u·P(u) [m N]", "Eq. (10.6)", u.dot(P(u)), 1e-6, "P is positive definite",
                  "Only then is z certain to be a direction of descent.");
  expect_true("without rows z is empty", "Eq. (10.6)", precondition<3>({}, {}, {}, 2).empty());
}

/// A step from λ along p, Eq. (10.8).
struct Step {
  Eigen::VectorXd aim, d, end;  ///< without bounds; the way to its projection; the lowest energy on that way
  bool whole = false;           ///< no bound limits it
};

Step step_along(const Eigen::VectorXd& p, const Eigen::VectorXd& lambda, const Bounded& of) {
  const Eigen::VectorXd r = of.B - of.S * lambda;
  const double alpha = p.dot(r) / p.dot(of.S * p);
  if (!(alpha > 0)) return {lambda, Eigen::VectorXd::Zero(p.size()), lambda};
  const Eigen::VectorXd aim = lambda + alpha * p, projected = aim.cwiseMax(of.lo).cwiseMin(of.hi);
  if (aim == projected) return {aim, aim - lambda, aim, true};
  const Eigen::VectorXd d = projected - lambda;
  const double t = d.isZero(0) ? 0 : std::clamp(d.dot(r) / d.dot(of.S * d), 0.0, 1.0);
  return {aim, d, lambda + t * d};
}

double energy(const Eigen::MatrixXd& S, const Eigen::VectorXd& B, const Eigen::VectorXd& lambda) {
  return 0.5 * lambda.dot(S * lambda) - B.dot(lambda);
}

void compare_with_enumeration(Problem<6>& p, const std::string& what) {
  const double tolerance = 1e-13;
  const SolveReport report = conjugate_solve(p.rows, p.V, {.max_sweeps = 5000, .tolerance = tolerance});
  const Bounded problem = bounded(p.rows);
  expect_true(
      what + ": converged within 5000 iterations", "Eq. (4.9)", report.converged,
      "Only sweeps take rows off a bound that they should leave. So sweep after a projected step, and when a "
      "row at a bound has the largest residual. After a sweep compute r anew, and set β = 0.");
  expect_near_vector("V of " + what + ", against M⁻¹ Gᵀ λ [m/s, rad/s]", "Eq. (10.8)", flat(p.V), moved(p),
                     roundings(1e6, 10), {},
                     "V and λ do not belong together. What is added to λ, t d after the projection, has to be "
                     "scattered.");
  const double n = static_cast<double>(p.rows.size());
  expect_near_vector("λ of " + what + " [N s]", "Eq. (4.1)", lambdas(p), enumerate_solution(problem),
                     {10 * n * condition(problem.S) * (tolerance + 1e-14), "residual times condition of S"}, {},
                     "All sets of active bounds were tried; this is the only solution.");
}

EXERCISE_TEST(ConjugateSolve, AgreesWithEveryEnumeratedProblem) {
  Random random;
  for (int rows = 1; rows <= 8; ++rows)
    for (int repeat = 0; repeat < 3; ++repeat) {
      Problem<6> p = random_problem(random, 2 + rows / 2, rows);
      compare_with_enumeration(p, std::to_string(rows) + " contacts");
    }
  for (int rows = 1; rows <= 7; ++rows) {
    Problem<6> p = random_problem(random, 2 + rows / 2, rows);
    give_bounds(random, p);
    compare_with_enumeration(p, std::to_string(rows) + " rows with bounds of all kinds");
  }
}

EXERCISE_TEST(ConjugateSolve, NeedsNoMoreIterationsThanRowsAndOne) {
  Random random;
  for (int rows = 1; rows <= 10; ++rows) {
    Problem<6> p = random_problem(random, 4, rows);
    take_bounds_off(p);
    Problem<6> again = p;
    const SolveReport report = conjugate_solve(p.rows, p.V, {.max_sweeps = 200, .tolerance = 1e-9});
    const SolveReport second = conjugate_solve(again.rows, again.V, {.max_sweeps = 200, .tolerance = 1e-9});
    if (report.history != second.history) this_failure_explains();
    expect_true("the history of " + std::to_string(rows) + " rows without bounds is the same in a second call",
                "Eq. (10.7)", report.history == second.history,
                "A value is kept from one call to the next, in a static or a global variable. The result must "
                "depend on the arguments only.");
    expect_at_most("iterations of " + std::to_string(rows) + " rows without bounds, to 1e-9 m/s", "Eq. (10.7)",
                   report.converged ? static_cast<double>(report.history.size()) : HUGE_VAL, rows + 1.0,
                   "as many steps as rows, and one iteration that finds convergence",
                   "Conjugate directions never repeat. Is β the new z·r over that of the step before? Is p "
                   "kept? Is there no sweep in between?");
  }
}

EXERCISE_TEST(ConjugateSolve, NeedsFewIterationsForAHeavyLoad) {
  // Without bounds this is a wire upside down. With 30 rows, sweeps alone take 200,000 to reach 1e-6.
  std::vector<double> masses(30, 1.0);
  masses.back() = 1000;
  Problem<3> p = stack(masses, 0.01);
  take_bounds_off(p);
  const SolveReport report = conjugate_solve(p.rows, p.V, {.max_sweeps = 1000, .tolerance = 1e-9});
  expect_at_most("iterations of 29 points of 1 kg with a load of 1000 kg", "Eq. (10.7)",
                 report.converged ? static_cast<double>(report.history.size()) : HUGE_VAL, 31,
                 "as many steps as rows, and one iteration that finds convergence",
                 "If the directions are not conjugate, mass ratios cost as much as with Gauss-Seidel.");
  expect_near("λ under the load, h M g [N s]", "Eq. (4.1)", p.rows.back().lambda, 0.01 * 9.81 * 1000,
              {1e-3, "tolerance 1e-9 m/s times a condition of 1e5"});
}

// The rows of a wire are coloured like a chessboard, so Jacobi's eigenvalues come in pairs ±μ. After the two sweeps of
// (10.6) each pair gives one eigenvalue: half as many steps suffice, and the load adds one. (Plain directions, z = r,
// have one for each row.)
EXERCISE_TEST(ConjugateSolve, NeedsHalfAsManyIterationsAsAWireHasLinks) {
  for (const double load : {1.0, 1e3, 1e6}) {
    std::vector<double> masses(100, 1.0);
    masses.back() = load;
    Problem<3> p = stack(masses, 0.01);
    take_bounds_off(p);
    const SolveReport report = conjugate_solve(p.rows, p.V, {.max_sweeps = 1000, .tolerance = 1e-9});
    expect_at_most(
        "iterations of a wire of 100 links with a load of " + show(load) + ":1, to 1e-9 m/s", "Eq. (10.6)",
        report.converged ? static_cast<double>(report.history.size()) : HUGE_VAL, 60,
        "half as many as links, and a few for round-off; without preconditioner about 100",
        "Is p made of z, after both sweeps of the preconditioner? Or is it made of r, or of r/S_kk?");
  }
}

// A row that its neighbours press against its bound has no part in the directions.
EXERCISE_TEST(ConjugateSolve, LeavesRowsAtTheirBoundsOutOfTheDirections) {
  for (const bool below : {true, false}) {
    std::vector<double> masses(20, 1.0);
    masses.back() = 1000;
    Problem<3> p = stack(masses, 0.01);
    take_bounds_off(p);
    for (std::size_t k = 0; k < 20; k += 2) {
      Row<3> held = p.rows[k];  // its B has the wrong sign for its bound, so λ = 0
      held.B = below ? -100 : 100;
      (below ? held.lo : held.hi) = 0;
      p.rows.push_back(held);
    }
    const SolveReport report = conjugate_solve(p.rows, p.V, {.max_sweeps = 1000, .tolerance = 1e-9});
    expect_at_most("iterations of 20 rows without bounds, and ten held at a bound from " +
                       std::string(below ? "below" : "above"),
                   "Eq. (10.7)", report.converged ? static_cast<double>(report.history.size()) : HUGE_VAL, 22,
                   "as many steps as free rows, one that met bounds, and one iteration that finds convergence",
                   "A row is free if it is strictly between its bounds, both of them. At a bound set r = 0 and "
                   "p = 0. Otherwise every step is projected, and its direction is lost.");
  }
}

void expect_within_bounds(const Problem<6>& p, int iterations) {
  for (const Row<6>& row : p.rows)
    expect_true("λ = " + show(row.lambda, 17) + " N s after " + std::to_string(iterations) +
                    " iterations, within [" + show(row.lo, 17) + ", " + show(row.hi, 17) + "]",
                "Eq. (10.8)", row.lambda >= row.lo && row.lambda <= row.hi,
                "A step goes no further than the bounds, and not by a rounding: λ + (hi - λ) may exceed hi.");
}

EXERCISE_TEST(ConjugateSolve, NeverLeavesTheBounds) {
  // A bound is met very near the unprojected step's end. Then t = 1, the step ends at the bound, and λ + (hi - λ) is
  // rounded.
  Random random;
  for (int repeat = 0; repeat < 1000 && !::testing::Test::HasFailure(); ++repeat) {
    Problem<6> p = random_problem(random, 4, 12);
    take_bounds_off(p);
    const Bounded free = bounded(p.rows);
    const Eigen::VectorXd from = forth(free.S, free.B), z = forth_and_back(free.S, free.B - free.S * from);
    const Eigen::VectorXd way = step_along(z, from, free).d;
    const int k = random.integer(0, 11);
    Row<6>& row = p.rows[static_cast<std::size_t>(k)];
    (way[k] > 0 ? row.hi : row.lo) = from[k] + 0.95 * way[k];
    conjugate_solve(p.rows, p.V, {.max_sweeps = 1, .tolerance = 0});
    expect_within_bounds(p, 1);
  }
}

EXERCISE_TEST(ConjugateSolve, NeverGainsEnergy) {
  Random random;
  for (int repeat = 0; repeat < 10; ++repeat) {
    Problem<6> start = random_problem(random, 4, 12);
    give_bounds(random, start);
    const Eigen::MatrixXd S = dense_S(start.rows);
    const Eigen::VectorXd B = gathered(start.rows, &Row<6>::B);
    double before = energy(S, B, lambdas(start));
    for (int iterations = 1; iterations <= 25; ++iterations) {
      Problem<6> p = start;
      conjugate_solve(p.rows, p.V, {.max_sweeps = iterations, .tolerance = 0});
      expect_within_bounds(p, iterations);
      const double now = energy(S, B, lambdas(p));
      expect_at_most(
          "E after " + std::to_string(iterations) + " iterations [J]", "Eq. (10.9)", now,
          before + 1e-12 * (1 + std::abs(before)), "that of the iteration before, and round-off",
          "Each of α and t stops at the lowest E along its path: α = p·r/p·Sp, and t = d·r/d·Sd, at most 1.");
      before = now;
    }
  }
}

// The unprojected point is far away, and E increases along most of the way to its projection.
EXERCISE_TEST(ConjugateSolve, StopsAtTheLowestEnergyOnTheWayToAProjection) {
  for (const double limit : {0.1, 1.0, 10.0}) {
    std::vector<double> masses(12, 1.0);
    masses.back() = 1000;
    Problem<3> start = stack(masses, 0.01);
    take_bounds_off(start);
    start.rows[5].hi = limit;  // a link that breaks under a larger load
    const Eigen::MatrixXd S = dense_S(start.rows);
    const Eigen::VectorXd B = gathered(start.rows, &Row<3>::B);
    double before = 0;
    for (int iterations = 1; iterations <= 20; ++iterations) {
      Problem<3> p = start;
      conjugate_solve(p.rows, p.V, {.max_sweeps = iterations, .tolerance = 0});
      const double now = energy(S, B, lambdas(p));
      expect_at_most("E of a wire whose link 5 carries at most " + show(limit) + " N s, after " +
                         std::to_string(iterations) + " iterations [J]",
                     "Eq. (10.8)", now, before + 1e-12 * (1 + std::abs(before)),
                     "that of the iteration before, and round-off",
                     "Not the whole way to the projected point: t = d·r/d·Sd, within [0, 1].");
      before = now;
    }
  }
}

// The header's second iteration, computed from the result of the first.
EXERCISE_TEST(ConjugateSolve, SweepsWhenABoundWasMetOrHasTheLargestResidual) {
  Random random;
  for (int repeat = 0; repeat < 40; ++repeat) {
    Problem<6> swept = random_problem(random, 5, 10);
    give_bounds(random, swept);
    const Problem<6> start = swept;
    sweep(swept.rows, swept.V);
    std::vector<bool> free(10);
    const Bounded problem = bounded(start.rows);
    const Eigen::VectorXd from = lambdas(swept);
    Eigen::VectorXd r = problem.B - problem.S * from;
    for (std::size_t k = 0; k < 10; ++k) {
      const Row<6>& row = swept.rows[k];
      free[k] = row.lo < row.lambda && row.lambda < row.hi;
      if (!free[k]) r[static_cast<Eigen::Index>(k)] = 0;
    }
    const Eigen::VectorXd z = as_eigen(precondition(swept.rows, as_std(r), free, swept.V.size()));
    if (!(z.dot(problem.S * z) > 0)) continue;
    const Step step = step_along(z, from, problem);
    const bool projected = !step.whole;

    Problem<6> once = start, twice = start;
    conjugate_solve(once.rows, once.V, {.max_sweeps = 1, .tolerance = 0});
    const SolveReport report = conjugate_solve(twice.rows, twice.V, {.max_sweeps = 2, .tolerance = 0});
    expect_near_vector(
        "λ after the first iteration, whose step is " + std::string(projected ? "projected" : "whole") +
            " [N s]",
        "Eq. (10.8)", lambdas(once), step.end, roundings(1000, 10),
        {{from, "This is the result of the sweep: there was no step."},
         {from + step.d, "This is the whole way to the projected point, not the fraction t of it."}},
        "d leads to the projected point; go the fraction t = d·r/d·Sd of it, within [0, 1].");
    double of_free = 0, of_others = 0;
    for (const Row<6>& row : once.rows) {
      const double lacks = residual(std::vector<Row<6>>{row}, once.V);
      double& largest = row.lo < row.lambda && row.lambda < row.hi ? of_free : of_others;
      largest = std::max(largest, lacks);
    }
    const bool sweeps = projected || of_others > of_free;
    if (sweeps) {
      Problem<6> anew = once;
      conjugate_solve(anew.rows, anew.V, {.max_sweeps = 1, .tolerance = 0});
      expect_near_vector("λ after a second iteration that sweeps, against one that starts afresh [N s]",
                         "Eq. (10.7)", lambdas(twice), lambdas(anew), roundings(1000, 10), {},
                         "After a sweep p is z alone: the old direction is no longer conjugate, so β = 0.");
    }
    const double lacked = residual(once.rows, once.V), returned = sweep(once.rows, once.V);
    expect_near(
        "the second entry of the history [m/s], after a step that was " +
            std::string(projected ? "projected" : "whole") +
            (of_others > of_free ? "; a row at a bound has the largest residual" : ""),
        "Eq. (4.9)", report.history.size() == 2 ? report.history[1] : std::nan(""), sweeps ? returned : lacked,
        roundings(1000, 10),
        {{lacked, projected
                      ? "There was no sweep, but the step before was projected: rows that should leave their "
                        "bounds need one."
                      : "There was no sweep, but a row at a bound has a larger residual than all free rows."},
         {returned,
          "There was a sweep, although no bound was met and a free row has the largest residual. The sweep "
          "destroys conjugacy."}},
        "The sweep's return value or, without a sweep, the residual of Eq. (4.8).");
  }
}

/// λ after each iteration of the header, from 0 and in matrices, until the residual is less than `least`.
std::vector<Eigen::VectorXd> iterated(const Bounded& of, int iterations, double least) {
  const Eigen::Index n = of.B.size();
  Eigen::VectorXd lambda = Eigen::VectorXd::Zero(n), p = lambda, r;
  std::vector<Eigen::Index> free;
  std::vector<Eigen::VectorXd> all;
  double zr = 0, lacking = 0;
  bool whole = false, left_behind = false;
  const auto look = [&] {
    r = of.B - of.S * lambda;
    const Eigen::VectorXd next = (lambda + r.cwiseQuotient(of.S.diagonal())).cwiseMax(of.lo).cwiseMin(of.hi),
                          lacks = of.S.diagonal().cwiseProduct(next - lambda).cwiseAbs();
    double of_free = 0, of_others = 0;
    free.clear();
    for (Eigen::Index k = 0; k < n; ++k) {
      const bool is_free = of.lo[k] < lambda[k] && lambda[k] < of.hi[k];
      if (is_free) free.push_back(k);
      (is_free ? of_free : of_others) = std::max(is_free ? of_free : of_others, lacks[k]);
    }
    left_behind = of_others > of_free;
    lacking = lacks.maxCoeff();
  };
  for (int done = 0; done < iterations; ++done) {
    look();
    if (lacking < least) break;
    const bool sweeps = !whole || left_behind;
    for (Eigen::Index k = 0; sweeps && k < n; ++k)
      lambda[k] = std::clamp(lambda[k] + (of.B[k] - of.S.row(k).dot(lambda)) / of.S(k, k), of.lo[k], of.hi[k]);
    look();
    if (lacking < least) break;
    Eigen::VectorXd z = Eigen::VectorXd::Zero(n);
    const Eigen::MatrixXd S = of.S(free, free);
    z(free) = forth_and_back(S, r(free));
    const double before = std::exchange(zr, z.dot(r));
    p = sweeps ? z : Eigen::VectorXd(z + zr / before * p);
    const Step step = step_along(p, lambda, of);
    whole = step.whole;
    lambda = step.end;
    all.push_back(lambda);
  }
  return all;
}

EXERCISE_TEST(ConjugateSolve, GoesByTheEquationsInEveryIteration) {
  Random random;
  for (int trial = 0; trial < 40 && !::testing::Test::HasFailure(); ++trial) {
    const auto [bodies, rows] = trial ? std::pair(5, 12) : std::pair(many / 2, many);
    Problem<6> start = random_problem(random, bodies, rows);
    give_bounds(random, start);
    const auto expected = iterated(bounded(start.rows), 8, 1e-6);  // less than that, and round-off would decide
    for (std::size_t n = 0; n < expected.size() && !::testing::Test::HasFailure(); ++n) {
      Problem<6> p = start;
      conjugate_solve(p.rows, p.V, {.max_sweeps = static_cast<int>(n) + 1, .tolerance = 0});
      expect_near_vector(
          "λ of " + std::to_string(rows) + " rows with bounds after iteration " + std::to_string(n + 1) +
              " [N s]",
          "Eq. (10.6)-(10.8)", lambdas(p), expected[n], {1e-9, "round-off, divided by the residual"}, {},
          "All iterations before this one were right. Is there a sweep if the last step was projected, or if a "
          "row at a bound has the largest residual, and in no other case? After a sweep p is z alone. " +
              ends_early);
    }
  }
}

EXERCISE_TEST(ConjugateSolve, KeepsVAndImpulsesTogether) {
  Random random;
  for (int iterations = 1; iterations <= 12; ++iterations) {
    Problem<6> p = random_problem(random, 4, 10);
    give_bounds(random, p);
    conjugate_solve(p.rows, p.V, {.max_sweeps = iterations, .tolerance = 0});
    expect_near_vector("V after " + std::to_string(iterations) + " iterations, against M⁻¹ Gᵀ λ [m/s, rad/s]",
                       "Eq. (10.8)", flat(p.V), moved(p), roundings(3000, 10), {},
                       "What is added to λ has to be scattered, digit for digit: t d, after the projection.");
  }
}

EXERCISE_TEST(ConjugateSolve, TakesTheSameRowTwice) {
  Random random;
  Problem<6> single = random_problem(random, 3, 4);
  for (Row<6>& row : single.rows) {
    row.diagonal -= row.Sigma;
    row.Sigma = 0;
  }
  Problem<6> p = single;
  for (const Row<6>& row : single.rows) p.rows.push_back(row);
  const SolveReport report = conjugate_solve(p.rows, p.V, {.max_sweeps = 2000, .tolerance = 1e-12});
  conjugate_solve(single.rows, single.V, {.max_sweeps = 2000, .tolerance = 1e-12});
  const Eigen::MatrixXd S = dense_S(single.rows);
  expect_true("four rows, each of them twice, Σ = 0: converged", "Eq. (4.9)", report.converged,
              "S is singular, but the energy has a lowest value.");
  expect_near_vector("V of rows that occur twice, against once [m/s, rad/s]", "Eq. (4.1)", flat(p.V),
                     flat(single.V), {1e-10 * condition(S), "tolerance times condition"}, {},
                     "The split of impulses between equal rows is arbitrary; their effect on V is not.");
}

EXERCISE_TEST(ConjugateSolve, StopsAtTheFirstIterationThatIsGoodEnough) {
  std::vector<double> masses(12, 1.0);
  Problem<3> p = stack(masses, 0.1), swept = p;
  take_bounds_off(p);
  const SolveReport report = conjugate_solve(p.rows, p.V, {.max_sweeps = 100, .tolerance = 1e-6});
  const std::size_t n = report.history.size();
  expect_true("it converges in 2 to 99 iterations; here it made " + std::to_string(n), "Eq. (4.9)",
              report.converged && n > 1 && n < 100,
              "Stop at the first iteration whose sweep, or residual, is at most the tolerance.");
  if (!report.converged) return;
  expect_near("the first entry of the history [m/s]", "Eq. (4.9)", report.history[0],
              sweep(swept.rows, swept.V), roundings(8, 1), {},
              "The first iteration starts with a sweep, and records what it returned.");
  expect_at_most("the last entry of the history [m/s]", "Eq. (4.9)", report.history[n - 1], 1e-6,
                 "the tolerance");
  for (std::size_t k = 0; k + 1 < n; ++k)
    expect_at_least("entry " + std::to_string(k + 1) + " of " + std::to_string(n) + " [m/s]", "Eq. (4.9)",
                    report.history[k], 1e-6, "above the tolerance", "It could have stopped earlier.");
  expect_at_most("residual at the end [m/s]", "Eq. (4.8)", residual(p.rows, p.V), 1e-5,
                 "of the order of the tolerance");
  // One step takes it from far above 1e-6 to round-off. Half of the lowest initial residual is met on the way.
  Problem<3> coarse = stack(masses, 0.1);
  take_bounds_off(coarse);
  const SolveReport under_way = conjugate_solve(coarse.rows, coarse.V, {.max_sweeps = 100, .tolerance = 0.5});
  expect_at_least("iterations to 0.5 m/s", "Eq. (4.9)", static_cast<double>(under_way.history.size()), 2,
                  "the first sweep's value is a fall of 0.98 m/s");
  if (under_way.history.empty()) return;
  expect_near("residual at the end, which is the last entry of the history [m/s]", "Eq. (4.8)",
              residual(coarse.rows, coarse.V), under_way.history.back(), roundings(100, 1), {},
              "Once the tolerance is met, change nothing.");
}

EXERCISE_TEST(ConjugateSolve, HasConvergedInTheLastIterationThatIsAllowed) {
  std::vector<double> masses(12, 1.0);
  Problem<3> p = stack(masses, 0.1);
  take_bounds_off(p);
  const Problem<3> start = p;
  const int needed =
      static_cast<int>(conjugate_solve(p.rows, p.V, {.max_sweeps = 100, .tolerance = 1e-6}).history.size());
  p = start;
  const SolveReport report =
      conjugate_solve(p.rows, p.V, {.max_sweeps = std::max(needed, 1), .tolerance = 1e-6});
  expect_true("allowed the " + std::to_string(needed) + " iterations that it took before: converged",
              "Eq. (4.9)", report.converged,
              "Apply the stop rule after an iteration's sweep, or its residual, and before its step. Do not "
              "wait for the next iteration: there may be none.");
  for (Row<3>& row : p.rows) row.B = 0;
  set_lambda(p, Eigen::VectorXd::Zero(12));
  const SolveReport nothing = conjugate_solve(p.rows, p.V, {.max_sweeps = 100, .tolerance = 0});
  expect_true("rows with residual 0, tolerance 0: converged in one iteration", "Eq. (4.9)",
              nothing.converged && nothing.history.size() == 1,
              "The rule is <= the tolerance, and 0 counts, too.");
}

EXERCISE_TEST(ConjugateSolve, StopsByTheRule) {
  Random random;
  for (const double size : {1e-3, 1.0, 1e3}) {  // of B: the tolerance is a velocity, not a fraction of it
    Problem<6> p = random_problem(random, 10, 20);
    for (Row<6>& row : p.rows) row.B *= size;
    const auto anew = [&](const StopRule& stop) {
      Problem<6> again = p;
      return conjugate_solve(again.rows, again.V, stop);
    };
    if (!expect_stops_by_the_rule("Eq. (4.9)", 12, anew)) return;
  }
}

EXERCISE_TEST(ConjugateSolve, StopsAtMaxIterations) {
  std::vector<double> masses(40, 1.0);
  Problem<3> p = stack(masses, 0.1);
  const SolveReport report = conjugate_solve(p.rows, p.V, {.max_sweeps = 5, .tolerance = 1e-12});
  expect_near("iterations made, of at most 5", "Eq. (4.9)", static_cast<double>(report.history.size()), 5,
              {0, "a count"});
  expect_true("and it has not converged", "Eq. (4.9)", !report.converged);
}

EXERCISE_TEST(ConjugateSolve, BeginsWhereItIs) {
  Random random;
  Problem<6> p = random_problem(random, 3, 7);
  const Problem<6> start = p;
  conjugate_solve(p.rows, p.V, {.max_sweeps = 1, .tolerance = 0});
  p = start;
  set_lambda(p, enumerate_solution(bounded(p.rows)));
  const SolveReport report = conjugate_solve(p.rows, p.V, {.max_sweeps = 100, .tolerance = 1e-9});
  expect_near("iterations when it starts at the solution", "Eq. (10.2)",
              static_cast<double>(report.history.size()), 1, {0, "a count"}, {},
              "λ and V on entry are a warm start: neither is set to zero.");
}

EXERCISE_TEST(ConjugateSolve, LetsASeparatingContactGo) {
  Problem<3> p = stack({1, 1, 1}, 0.01);
  p.rows[2].B = -1;  // the top one is thrown up
  set_lambda(p, Eigen::VectorXd::Constant(3, 2));
  conjugate_solve(p.rows, p.V, {.max_sweeps = 100, .tolerance = 1e-14});
  expect_near("λ under a body that leaves its contact [N s]", "Eq. (4.1)", p.rows[2].lambda, 0, {0, "exact"});
  expect_near("λ under the two that stay in contact [N s]", "Eq. (4.1)", p.rows[0].lambda, 0.01 * 9.81 * 2,
              roundings(100));
  // The other two are thrown up as well. After the first sweep no row is free, and no direction is left.
  Problem<3> all = stack({1, 1, 1}, 0.01);
  for (Row<3>& row : all.rows) row.B = -1;
  set_lambda(all, Eigen::VectorXd::Constant(3, 2));
  const SolveReport report = conjugate_solve(all.rows, all.V, {.max_sweeps = 10, .tolerance = 1e-14});
  expect_near_vector("λ under three bodies that leave their contacts [N s]", "Eq. (4.1)", lambdas(all),
                     Eigen::VectorXd::Zero(3), {0, "exact"}, {},
                     "With no free row p is 0, and α = 0/0. Take no step: the next iteration sweeps.");
  expect_near("entries of its history", "Eq. (4.9)", static_cast<double>(report.history.size()), 2,
              {0, "one sweep that sets λ = 0, and one that finds convergence"});
}

EXERCISE_TEST(ConjugateSolve, DoesNotTakeANaNForConverged) {
  Problem<3> p = stack({1, 1, 1}, 0.1);
  p.rows[1].B = std::nan("");
  const SolveReport report = conjugate_solve(p.rows, p.V, {.max_sweeps = 5, .tolerance = 1e-6});
  expect_true("a solve of NaN has not converged, and its history contains NaN", "Eq. (4.9)",
              !report.converged && !report.history.empty() && std::isnan(report.history.back()),
              "Every comparison with NaN is false: ask whether it is <= the tolerance.");
}

EXERCISE_TEST(ConjugateSolve, SeesANaNThatIsAloneInItsIsland) {
  // Four pairs of bodies, with one row each. The NaN is in one of them and never reaches another row. Nor does it reach
  // one without a bound, which is free and enters the direction.
  for (const bool bounds : {true, false})
    for (std::size_t broken = 0; broken < 4; ++broken) {
      Problem<3> p;
      const Twist<3> up(0, 0, 1);
      p.motion = {.inverse_mass = std::vector<InverseMass<3>>(8, {.linear = 1}),
                  .W = std::vector<Twist<3>>(8, -up),
                  .Wf = std::vector<Twist<3>>(8, Twist<3>::Zero())};
      p.V = p.motion.Wf;
      for (int k = 0; k < 4; ++k) {
        p.motion.W[static_cast<std::size_t>(2 * k)].setZero();
        p.rows.push_back(make_row<3>({.i = 2 * k,
                                      .j = 2 * k + 1,
                                      .Gi = -up,
                                      .Gj = up,
                                      .gap = 0,
                                      .spook = {.a = 0, .b = 1, .Sigma = 0.1}},
                                     p.motion));
      }
      if (!bounds) take_bounds_off(p);
      p.rows[broken].B = std::nan("");
      const SolveReport report = conjugate_solve(p.rows, p.V, {.max_sweeps = 6, .tolerance = 1e-6});
      const bool all =
          std::all_of(report.history.begin(), report.history.end(), [](double r) { return std::isnan(r); });
      expect_true("a NaN in row " + std::to_string(broken) +
                      " of four that share no body: each entry of the history is "
                      "NaN, and it has not converged",
                  "Eq. (4.9)", !report.converged && !report.history.empty() && all,
                  "A NaN was lost. std::max(a, NaN) is a, also where the maximum of the free rows meets that "
                  "of the others. Once the maximum is NaN, no later row may replace it.");
    }
}

// These come late, since every mistake fails them, and their clue is about one kind only.
EXERCISE_TEST(ConjugateSolve, DropsNothingSmall) {
  for (const double part : relative_scales)
    for (Problem<3>& p : unlike_problems(part)) {
      const Eigen::MatrixXd S = dense_S(p.rows);
      const Eigen::VectorXd B = gathered(p.rows, &Row<3>::B);
      conjugate_solve(p.rows, p.V, {.max_sweeps = 30, .tolerance = 1e-15});
      expect_near_vector("λ of three rows, for B = " + show(Eigen::MatrixXd(B)) +
                             " m/s and S_kk = " + show(Eigen::MatrixXd(S.diagonal())) + " /kg [N s]",
                         "Eq. (10.7)", gathered(p.rows, &Row<3>::lambda), solution_of(S, B),
                         {2e-14, "round-off of each iteration, times a condition of 4"}, {}, small_is_dropped);
      if (::testing::Test::HasFailure()) return;
    }
}

EXERCISE_TEST(ConjugateSolve, CountsWhatIsSmallInEveryStep) {
  for (const double part : {1e-1, 1e-2, 1e-3, 1e-5, 1e-7, 1e-9, 1e-11})
    for (const Problem<3>& start : unlike_problems(part)) {
      const Eigen::MatrixXd S = dense_S(start.rows);
      const Eigen::VectorXd B = gathered(start.rows, &Row<3>::B);
      const std::string of = ", for B = " + show(Eigen::MatrixXd(B)) +
                             " m/s and S_kk = " + show(Eigen::MatrixXd(S.diagonal())) + " /kg [N s]";
      const auto expected = iterated(bounded(start.rows), 3, 0);
      for (int n = 0; n < static_cast<int>(expected.size()); ++n) {
        Problem<3> p = start;
        conjugate_solve(p.rows, p.V, {.max_sweeps = n + 1, .tolerance = 0});
        expect_near_vector("λ after iteration " + std::to_string(n + 1) + " of some rows" + of, "Eq. (10.7)",
                           lambdas(p), expected[static_cast<std::size_t>(n)],
                           {2e-14, "round-off of each iteration, times a condition of 4"}, {},
                           small_is_dropped);
        if (::testing::Test::HasFailure()) return;
      }
    }
}

EXERCISE_TEST(ConjugateSolve, CountsWhatIsSmallWhereABoundIsMet) {
  for (const double part : relative_scales)
    for (const Problem<3>& start : unlike_problems(part)) {
      const auto [S, B, lo, hi] = bounded(start.rows);
      const Eigen::VectorXd from = forth(S, B), z = forth_and_back(S, B - S * from);
      if (!(z.dot(S * z) > 1e-20)) continue;
      const Eigen::VectorXd aim = step_along(z, from, {S, B, lo, hi}).aim;
      for (Eigen::Index k = 0; k < B.size(); ++k) {  // a bound of row k, half way along the step
        if (std::abs(aim[k] - from[k]) < 1e-2) continue;
        Problem<3> p = start;
        Row<3>& row = p.rows[static_cast<std::size_t>(k)];
        const double bound = (from[k] + aim[k]) / 2;
        (aim[k] > from[k] ? row.hi : row.lo) = bound;
        const Step step = step_along(z, from, bounded(p.rows));
        conjugate_solve(p.rows, p.V, {.max_sweeps = 1, .tolerance = 0});
        expect_near_vector("λ after a step that meets a bound of row " + std::to_string(k) +
                               ", for B = " + show(Eigen::MatrixXd(B)) +
                               " m/s and S_kk = " + show(Eigen::MatrixXd(S.diagonal())) + " /kg [N s]",
                           "Eq. (10.8)", lambdas(p), step.end,
                           {2e-14, "some units of round-off, times a condition of 4"}, {}, small_is_dropped);
        if (::testing::Test::HasFailure()) return;
      }
    }
}

EXERCISE_TEST(ConjugateSolve, RejectsARuleThatCannotBeMet) {
  std::vector<Row<3>> none;
  std::vector<Twist<3>> V;
  const SolveReport report = conjugate_solve(none, V, {});
  expect_true("no rows: converged after 0 iterations", "Eq. (4.9)", report.converged && report.history.empty());
  expect_rejects(
      "max_sweeps = 0", "max_sweeps", [&] { conjugate_solve(none, V, {.max_sweeps = 0, .tolerance = 0}); },
      "The contract is that of solve(): refuse a rule that cannot be met, with rows or without.");
  Problem<3> p = stack({1, 2}, 0.1);
  expect_rejects(
      "max_sweeps = 0, with rows", "max_sweeps",
      [&] { conjugate_solve(p.rows, p.V, {.max_sweeps = 0, .tolerance = 0}); }, "", state_of(p.rows, p.V));
  for (const double tolerance : {-1e-9, std::nan(""), HUGE_VAL})
    expect_rejects("tolerance = " + show(tolerance), "tolerance",
                   [&] { conjugate_solve(none, V, {.max_sweeps = 5, .tolerance = tolerance}); });
}

}  // namespace
