// One sweep over all rows, and the residual.
#include "algebra.hpp"
#include "cancellation.hpp"
#include "exercise_test.hpp"
#include "operations.hpp"
#include "problems.hpp"
#include "random_input.hpp"
#include "regions.hpp"

using namespace spook;
using namespace spook::testing;

namespace {

EXERCISE(Sweep, "4.4 sweep");
EXERCISE(Residual, "4.5 residual");

Eigen::VectorXd swept(const Eigen::MatrixXd& S, const Eigen::VectorXd& B, Eigen::VectorXd lambda, bool fresh,
                      bool backwards) {
  const Eigen::VectorXd old = lambda;
  for (Eigen::Index step = 0; step < B.size(); ++step) {
    const Eigen::Index k = backwards ? B.size() - 1 - step : step;
    lambda[k] = old[k] + (B[k] - S.row(k).dot(fresh ? lambda : old)) / S(k, k);
  }
  return lambda;
}

EXERCISE_TEST(Sweep, IsOneGaussSeidelIteration) {
  Random random;
  Problem<6> p = random_problem(random, 3, 6);
  for (auto& row : p.rows) row.lo = -infinity;
  const Eigen::MatrixXd S = dense_S(p.rows);
  const Eigen::VectorXd B = gathered(p.rows, &Row<6>::B);
  set_lambda(p, Eigen::VectorXd::Constant(6, 0.3));
  const Eigen::VectorXd start = gathered(p.rows, &Row<6>::lambda);
  sweep(p.rows, p.V);
  expect_near_vector(
      "λ of six coupled rows after one sweep [N s]", "Eq. (4.2)", gathered(p.rows, &Row<6>::lambda),
      swept(S, B, start, true, false), roundings(1000, 10),
      {{swept(S, B, start, false, false),
        "This is Jacobi's iteration: each row used the λ of the others before the sweep. Scatter every update "
        "immediately."},
       {swept(S, B, start, true, true), "The rows were swept from the last to the first."},
       {start, "No row has changed."},
       {swept(S, B, swept(S, B, start, true, false), true, false), "These are two sweeps."},
       {swept(S, B, swept(S, B, start, true, false), true, true), "This swept forwards and then backwards."}},
      "Every row once, in order, by update_row.");
}

EXERCISE_TEST(Sweep, ContractsTheStackAtItsExactRate) {
  for (const double Sigma : {0.0, 0.1})
    for (const double ratio : {0.01, 1.0, 10.0, 100.0}) {
      Problem<3> p = stack({1, ratio}, 0.1, Sigma);
      const Eigen::VectorXd exact = solution_of(dense_S(p.rows), gathered(p.rows, &Row<3>::B));
      const double rho = 1 / ((1 + Sigma) * (1 + 1 / ratio + Sigma));
      for (int n = 1; n <= 5; ++n) {
        sweep(p.rows, p.V);
        expect_near("error of the upper λ after sweep " + std::to_string(n) +
                        ", over the one before the first; ratio " + show(ratio) + ", Σ = " + show(Sigma),
                    "Eq. (4.10)", (exact[1] - p.rows[1].lambda) / exact[1], std::pow(rho, n),
                    {1e-11, "1e5 roundings, by the condition of S at the mass ratio 100"},
                    {{std::pow(rho, n / 2.0),
                      "This is the rate of Jacobi's iteration, the square root of Gauss-Seidel's."}},
                    "A light body under a heavy one: ρ = 1/((1+mΣ)(1+m/M+mΣ)) a sweep.");
      }
    }
}

EXERCISE_TEST(Sweep, ReturnsTheLargestVelocityChange) {
  Random random;
  Problem<6> p = random_problem(random, 4, 10);
  const auto before = p.rows;
  const double got = sweep(p.rows, p.V);
  double largest = 0, without_diagonal = 0, last = 0, sum = 0;
  for (std::size_t k = 0; k < before.size(); ++k) {
    const double change = std::abs(p.rows[k].lambda - before[k].lambda);
    last = change * before[k].diagonal;
    largest = std::max(largest, last);
    sum += last;
    without_diagonal = std::max(without_diagonal, change);
  }
  expect_near("what a sweep of 10 rows returns [m/s]", "Eq. (4.9)", got, largest, roundings(64, 10),
              {{without_diagonal,
                "This is the largest |Δλ|, an impulse. Multiply it by S_kk: this velocity can be compared "
                "between rows."},
               {last, "This is the last row's, not the largest."},
               {sum, "This is the sum over the rows, not the largest."}},
              "The largest S_kk |Δλ_k| of the sweep.");
}

/// Rows skipped by mistake: rows that would stay at a bound before the sweep, contacts among these, or all contacts
/// with λ = 0; or rows with equal bounds.
enum class Skips { at_any_bound, contacts_that_stay_off, contacts_off, equal_bounds };

/// λ after three sweeps.
Eigen::VectorXd swept_but_for(const Bounded& problem, Eigen::VectorXd lambda, Skips skips) {
  for (int round = 0; round < 3; ++round) {
    const Eigen::VectorXd before = problem.B - problem.S * lambda;
    for (Eigen::Index k = 0; k < lambda.size(); ++k) {
      const double lo = problem.lo[k], hi = problem.hi[k];
      const bool stays = (lambda[k] == lo && before[k] <= 0) || (lambda[k] == hi && before[k] >= 0);
      const bool is_off = lo == 0 && hi == infinity && lambda[k] == 0;
      if (skips == Skips::equal_bounds   ? lo == hi
          : skips == Skips::at_any_bound ? stays
                                         : is_off && (stays || skips == Skips::contacts_off))
        continue;
      const double r = problem.B[k] - problem.S.row(k).dot(lambda);
      lambda[k] = std::min(hi, std::max(lo, lambda[k] + r / problem.S(k, k)));
    }
  }
  return lambda;
}

EXERCISE_TEST(Sweep, TakesAnyBoundsAndAnyStart) {
  Random random;
  Regions regions({"has λ = 0, and is pushed later in the sweep", "had λ = 0, and pushes in the next sweep",
                   "lets go again", "more than eight bodies", "a hundred rows"});
  while (regions.lack_draws()) {
    const int bodies = random.integer(2, 14), rows = random.integer(0, 3) ? 20 : many;
    Problem<6> p = any_rows(random, bodies, rows);
    const Bounded problem = bounded(p.rows);
    Eigen::VectorXd lambda = gathered(p.rows, &Row<6>::lambda);
    bool pushed_later = false, pushes_next = false, lets_go = false;
    std::vector<double> largest;
    for (int round = 0; round < 3; ++round) {
      const Eigen::VectorXd old = lambda;
      double most = 0;
      for (Eigen::Index k = 0; k < lambda.size(); ++k) {
        const double r = problem.B[k] - problem.S.row(k).dot(lambda);
        const double next = std::min(problem.hi[k], std::max(problem.lo[k], lambda[k] + r / problem.S(k, k)));
        most = std::max(most, problem.S(k, k) * std::abs(next - lambda[k]));
        lambda[k] = next;
      }
      largest.push_back(most);
      const Eigen::VectorXd r = problem.B - problem.S * lambda;
      for (Eigen::Index k = 0; k < lambda.size(); ++k) {
        const bool is_contact = problem.lo[k] == 0 && problem.hi[k] == infinity, off = lambda[k] == 0;
        pushed_later = pushed_later || (is_contact && off && r[k] > 0);
        pushes_next = pushes_next || (is_contact && round > 0 && old[k] == 0 && !off);
        lets_go = lets_go || (is_contact && round > 0 && old[k] > 0 && off);
      }
    }
    regions.draw({{"has λ = 0, and is pushed later in the sweep", pushed_later},
                  {"had λ = 0, and pushes in the next sweep", pushes_next},
                  {"lets go again", lets_go},
                  {"more than eight bodies", bodies > 8},
                  {"a hundred rows", rows == many}});
    const std::string of = std::to_string(rows) + " rows";
    const Eigen::VectorXd start = gathered(p.rows, &Row<6>::lambda), V_before = joined_V(p);
    std::vector<double> returned;
    for (int round = 0; round < 3; ++round) returned.push_back(sweep(p.rows, p.V));
    Problem<6> again = p;
    set_lambda(again, gathered(p.rows, &Row<6>::lambda));
    expect_near_vector("V after three sweeps, against M⁻¹ Gᵀ λ of the λ that they left", "Eq. (4.5)",
                       joined_V(p), joined_V(again), roundings(1e5, 10),
                       {{V_before, "V has not changed: every update must scatter to it."}},
                       "V = M⁻¹ Gᵀ λ, after every update.");
    const std::string skipped =
        "Rows have been skipped by the V before the sweep. Other updates change V, so decide for each row by "
        "the present V.";
    expect_near_vector(
        "λ of " + of + " after three sweeps [N s]", "Eq. (4.2), (4.7)", gathered(p.rows, &Row<6>::lambda),
        lambda, roundings(1e5, 10),
        {{swept_but_for(problem, start, Skips::at_any_bound), skipped},
         {swept_but_for(problem, start, Skips::contacts_that_stay_off), skipped},
         {swept_but_for(problem, start, Skips::equal_bounds),
          "Rows with lo = hi have been skipped. Their λ may begin elsewhere, and is then projected."},
         {swept_but_for(problem, start, Skips::contacts_off),
          "Contacts with λ = 0 have been skipped. Another update may push them later, so update them, too."}},
        "Every row is updated in every sweep, within its own bounds, from the present V: a row with λ = 0 may "
        "be pushed later. " +
            ends_early);
    for (std::size_t round = 0; round < largest.size(); ++round)
      expect_near("what sweep " + std::to_string(round + 1) + " of three over " + of + " between " +
                      std::to_string(bodies) + " bodies returned [m/s]",
                  "Eq. (4.9)", returned[round], largest[round], roundings(1e5, 10), {},
                  "The largest S_kk |Δλ_k|. Every row is updated in every sweep: a row with λ = 0 may be "
                  "pushed later.");
  }
}

EXERCISE_TEST(Sweep, CountsARowThatLetsGo) {
  Problem<3> p = stack({1}, 0.1);
  p.rows[0].lambda = 5;
  p.V[1].z() = 5;
  expect_near("what a sweep returns when λ falls from 5 N s to h m g = 0.981 N s, S_kk = 1/kg [m/s]",
              "Eq. (4.9)", sweep(p.rows, p.V), 5 - 0.981, roundings(16, 5),
              {{0, "A negative Δλ is a change, too: take |Δλ|."}});
}

EXERCISE_TEST(Sweep, OfNothingChangesNothing) {
  std::vector<Row<3>> none;
  std::vector<Twist<3>> V(3, Twist<3>::Ones());
  expect_near("what a sweep of no rows returns [m/s]", "Eq. (4.9)", sweep(none, V), 0, {0, "exact"}, {},
              "Without rows the maximum is 0: start it at 0.");
}

EXERCISE_TEST(Sweep, DoesNotHideANaN) {
  Problem<3> p = stack({1, 1, 1}, 0.1);
  p.rows[1].B = std::nan("");
  p.rows[2].j = 0;  // ends on the floor: the row after the NaN is valid itself, but its neighbour is not
  p.rows[2].i = 0;
  expect_true("a sweep with a NaN in one row returns NaN", "Eq. (4.9)", std::isnan(sweep(p.rows, p.V)),
              "The NaN was lost. std::max(a, NaN) is a, in the running maximum and in a projection (std::clamp "
              "keeps a NaN). Once the maximum is NaN, no later row may replace it.");
}

EXERCISE_TEST(Residual, IsZeroAtTheSolution) {
  Random random;
  Problem<6> p = random_problem(random, 3, 7);
  set_lambda(p, enumerate_solution(bounded(p.rows)));
  double unprojected = 0, without_sigma = 0;
  for (const Row<6>& row : p.rows) {
    const double r = row.B - row.Gi.dot(p.V[static_cast<std::size_t>(row.i)]) -
                     row.Gj.dot(p.V[static_cast<std::size_t>(row.j)]) - row.Sigma * row.lambda;
    unprojected = std::max(unprojected, std::abs(r));
    const double next = std::max(0.0, row.lambda + (r + row.Sigma * row.lambda) / row.diagonal);
    without_sigma = std::max(without_sigma, row.diagonal * std::abs(next - row.lambda));
  }
  expect_near("residual at the exact solution of 7 contacts [m/s]", "Eq. (4.8)", residual(p.rows, p.V), 0,
              roundings(3000, 10),
              {{unprojected,
                "This is the largest |r|, which counts contacts that rightly come apart. A row at its bound "
                "with r pointing outwards is solved."},
               {without_sigma, "Σ λ is missing in r = B - G V - Σ λ."}});
}

EXERCISE_TEST(Residual, IsWhatTheNextUpdateWouldChange) {
  Random random;
  Problem<6> p = random_problem(random, 4, 9);
  sweep(p.rows, p.V);
  double expected = 0, impulse = 0;
  for (const Row<6>& row : p.rows) {
    Row<6> next = row;
    std::vector<Twist<6>> V = p.V;
    const double change = std::abs(update_row(next, V));
    expected = std::max(expected, row.diagonal * change);
    impulse = std::max(impulse, change);
  }
  expect_near("residual of 9 contacts after one sweep [m/s]", "Eq. (4.8)", residual(p.rows, p.V), expected,
              roundings(100, 10),
              {{impulse, "This is the largest |Δλ|, an impulse. Times S_kk it is a velocity."}},
              "r = B - G V - Σ λ, then Eq. (4.8). All rows use the same V: do not scatter, and return the "
              "largest.");
}

EXERCISE_TEST(Residual, CountsTooLargeAndTooSmallImpulses) {
  Problem<3> p = stack({2}, 0.1, 0.125, 10);  // S_kk = 5/8, B = 1
  const double exact = 1 / 0.625;
  for (const double lambda : {0.0, exact / 2, 2 * exact}) {
    set_lambda(p, Eigen::VectorXd::Constant(1, lambda));
    const double expected = 0.625 * std::abs(lambda - exact);
    expect_near(
        "residual of one contact with λ = " + show(lambda) + " N s [m/s]", "Eq. (4.8)", residual(p.rows, p.V),
        expected, roundings(16, 2),
        {{std::abs(1 - 0.5 * lambda), "Σ λ is missing in r = B - G V - Σ λ."},
         {0, lambda > 0 ? "A λ that is too large counts, too: take the absolute value."
                        : "A λ that is too small counts, too: take the absolute value. A row at a bound "
                          "is not solved if its update would leave the bound."}});
  }
}

EXERCISE_TEST(Residual, ProjectsOnTheRowsOwnBounds) {
  Problem<3> p = stack({2}, 0.1, 0.125, 10);  // S_kk = 5/8, and without bounds λ = 1.6 B
  struct Case {
    double B, lo, hi, lambda, next;
  };
  for (const Case& c : {Case{1, -0.5, 0.75, 0.75, 0.75},
                        {1, -0.5, 0.75, 0.25, 0.75},
                        {-1, -0.25, 0.75, -0.25, -0.25},
                        {-1, -0.25, 0.75, 0.5, -0.25},
                        {1, 2, 3, 2.5, 2},
                        {1, 2, 3, 2, 2},
                        {1, -0.5, 0.75, 1.5, 0.75},  // begins beyond its bound
                        {-1, -0.25, 0.75, -1, -0.25},
                        {-1, -3, -2, -3, -2}}) {
    p.rows[0].B = c.B;
    p.rows[0].lo = c.lo;
    p.rows[0].hi = c.hi;
    set_lambda(p, Eigen::VectorXd::Constant(1, c.lambda));
    const auto lacks = [&](double next) { return 0.625 * std::abs(next - c.lambda); };
    expect_near(
        "residual of one row with B = " + show(c.B) + " m/s, " + show(c.lo) + " <= λ <= " + show(c.hi) +
            " and λ = " + show(c.lambda) + " N s [m/s]",
        "Eq. (4.8)", residual(p.rows, p.V), lacks(c.next), roundings(16, 4),
        {{0.625 * std::abs(c.next - std::clamp(c.lambda, c.lo, c.hi)),
          "This counts nothing of the way from λ back to its bounds. Subtract λ as it is, not clamped."},
         {lacks(1.6 * c.B), "This row was not projected at all."},
         {lacks(std::max(1.6 * c.B, 0.0)),
          "This row was projected on 0 and infinity, a contact's bounds. It has bounds of its own."}},
        "Project on this row's own bounds, row.lo and row.hi.");
  }
}

EXERCISE_TEST(Residual, TakesAnyBoundsAndAnyStart) {
  Random random;
  // The row with the largest residual is of each kind in turn, so an answer that leaves out a kind is noticed.
  Regions regions({"the row with the largest residual is between its bounds",
                   "the row with the largest residual is at its "
                   "lower bound",
                   "the row with the largest residual is at its upper bound",
                   "the row with the largest residual is below "
                   "its lower bound",
                   "the row with the largest residual is above its upper bound",
                   "of a hundred rows one of the last has the "
                   "largest residual"});
  while (regions.lack_draws()) {
    const int bodies = random.integer(2, 14), rows = random.integer(0, 3) ? 20 : many;
    const Problem<6> p = any_rows(random, bodies, rows);
    const Bounded problem = bounded(p.rows);
    const Eigen::VectorXd lambda = gathered(p.rows, &Row<6>::lambda), r = problem.B - problem.S * lambda;
    double largest = 0, without_sigma = 0, without_equal_bounds = 0;
    Eigen::Index most = 0;
    for (Eigen::Index k = 0; k < lambda.size(); ++k) {
      const double S_kk = problem.S(k, k), Sigma = p.rows[static_cast<std::size_t>(k)].Sigma;
      const auto lacks = [&](double lacking) {
        const double next = std::min(problem.hi[k], std::max(problem.lo[k], lambda[k] + lacking / S_kk));
        return S_kk * std::abs(next - lambda[k]);
      };
      if (lacks(r[k]) > largest) most = k;
      largest = std::max(largest, lacks(r[k]));
      without_sigma = std::max(without_sigma, lacks(r[k] + Sigma * lambda[k]));
      if (problem.lo[k] < problem.hi[k]) without_equal_bounds = std::max(without_equal_bounds, lacks(r[k]));
    }
    const double at = lambda[most], lo = problem.lo[most], hi = problem.hi[most];
    regions.draw(
        {{"the row with the largest residual is between its bounds", lo < at && at < hi},
         {"the row with the largest residual is at its lower bound", at == lo},
         {"the row with the largest residual is at its upper bound", at == hi},
         {"the row with the largest residual is below its lower bound", at < lo},
         {"the row with the largest residual is above its upper bound", at > hi},
         {"of a hundred rows one of the last has the largest residual", rows == many && most >= 2 * many / 3}});
    expect_near(
        "residual of " + std::to_string(rows) + " rows with bounds of all kinds, λ within them or not [m/s]",
        "Eq. (4.8)", residual(p.rows, p.V), largest, roundings(1e4, 10),
        {{without_sigma, "Σ λ is missing in r = B - G V - Σ λ."},
         {without_equal_bounds,
          "Rows with lo = hi have been left out. Where λ is not at that bound, such a row is not solved."}},
        "The change that an update would make, times S_kk, of every row: also of rows at a bound that would "
        "leave it. Of " +
            std::to_string(rows) + " rows the last counts like the first.");
  }
}

EXERCISE_TEST(Residual, OfNothingIsZeroAndOfNaNIsNaN) {
  Problem<3> p = stack({1, 1, 1}, 0.1);
  expect_near("residual of no rows [m/s]", "Eq. (4.8)", residual<3>({}, p.V), 0, {0, "exact"});
  p.rows[1].B = std::nan("");
  expect_true("a NaN in one row makes the residual NaN", "Eq. (4.8)", std::isnan(residual(p.rows, p.V)),
              "The NaN was lost. std::max(a, NaN) is a, in the running maximum and in a projection (std::clamp "
              "keeps a NaN). Once the maximum is NaN, no later row may replace it.");
}

EXERCISE_TEST(Residual, HasACostProportionalToTheRows) {
  const auto operations = [](int bodies) {
    const Problem<3> p = stack(std::vector<double>(static_cast<std::size_t>(bodies), 1.0), 0.1);
    return operations_of([&] { residual(p.rows, p.V); });
  };
  expect_growth(
      "the residual of 800 rows", "Eq. (4.8)", operations(100), operations(800), 800 / 16, 12,
      "a part for each row makes it 8, and one for each pair of rows 64",
      "The residual should cost about as much as a sweep, since each row reads two bodies. A copy of all "
      "velocities for each row is quadratic.");
}

EXERCISE_TEST(Residual, DropsNothingSmall) {
  const Twist<3> up(0, 0, 1);
  for (const double part : relative_scales) {  // a light body, whose row is solved, and a heavy one
    const auto row = [&](double inverse_mass, double B) {
      return Row<3>{.i = 0,
                    .j = 1,
                    .Gi = Twist<3>::Zero(),
                    .Gj = up,
                    .MinvGi = Twist<3>::Zero(),
                    .MinvGj = inverse_mass * up,
                    .B = B,
                    .Sigma = 0,
                    .diagonal = inverse_mass,
                    .lo = 0,
                    .hi = infinity};
    };
    const std::vector<Twist<3>> V(2, Twist<3>::Zero());
    expect_near("residual of a row that lacks 3 m/s, beside one with a diagonal that is " + show(1 / part) +
                    " times as large [m/s]",
                "Eq. (4.8)", residual<3>({row(1, 0), row(part, 3)}, V), 3, roundings(8, 3),
                {{0, "It has been left out. " + small_is_dropped}}, small_is_dropped);
    for (const CancellationCase& of : cancellation_cases(part))
      expect_near("residual of a row with " + of.text + " [m/s]", "Eq. (4.8)", residual<3>({of.row}, of.V),
                  std::abs(of.lacks), roundings(8), {}, small_is_dropped);
    if (::testing::Test::HasFailure()) return;
  }
}

}  // namespace
