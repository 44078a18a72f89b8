// Orders of rows: sorted, random, and swept.
#include <map>

#include "algebra.hpp"
#include "exercise_test.hpp"
#include "random_input.hpp"
#include "systems.hpp"

using namespace spook;
using namespace spook::testing;

namespace {

EXERCISE(OrderAlong, "10.3 order_along");
EXERCISE(RandomOrder, "10.4 random_order");
EXERCISE(SweepInOrder, "10.5 sweep_in_order");

void expect_order_of(const std::string& what, const std::vector<int>& got, const std::vector<int>& expected,
                     std::initializer_list<Clue<Eigen::VectorXd>> clues, const std::string& otherwise = "") {
  expect_true(what + ": each index once", "Eq. (10.3)", has_each_once(got, static_cast<int>(expected.size())));
  if (got.size() == expected.size())
    expect_near_vector(what, "Eq. (10.3)", as_eigen(got), as_eigen(expected), {0, "indices"}, clues, otherwise);
}

EXERCISE_TEST(OrderAlong, GoesFromTheLowestToTheHighest) {
  expect_order_of("the order of heights 2.5, -1, 4, 0.5, 3", order_along({2.5, -1, 4, 0.5, 3}), {1, 3, 0, 4, 2},
                  {{as_eigen(std::vector<int>{2, 4, 0, 3, 1}), "This is from the highest to the lowest."},
                   {as_eigen(std::vector<int>{2, 0, 4, 1, 3}),
                    "This tells the place of each row. The order says which row is at each place."},
                   {as_eigen(std::vector<int>{3, 1, 0, 4, 2}),
                    "A height below zero is lower than zero: take no absolute value."}},
                  "The index of the lowest row comes first, then that of the next.");
}

EXERCISE_TEST(OrderAlong, SortsAnything) {
  Random random;
  for (const int n : {100, 100'000}) {
    std::vector<double> heights;
    for (int k = 0; k < n; ++k) heights.push_back(random.uniform(-5, 5));
    const auto order = order_along(heights);
    expect_true("each of " + std::to_string(n) + " indices once", "Eq. (10.3)", has_each_once(order, n));
    if (!has_each_once(order, n)) return;
    for (std::size_t k = 1; k < order.size() && !::testing::Test::HasFailure(); ++k)
      expect_at_least("height of row " + std::to_string(order[k]) + " at place " + std::to_string(k) + " [m]",
                      "Eq. (10.3)", heights[static_cast<std::size_t>(order[k])],
                      heights[static_cast<std::size_t>(order[k - 1])], "that of the place before");
  }
}

EXERCISE_TEST(OrderAlong, KeepsEqualHeightsInOrder) {
  std::vector<double> heights(60, 1.0);
  for (std::size_t k = 0; k < heights.size(); k += 3) heights[k] = 0.5;
  std::vector<int> expected;
  for (int k = 0; k < 60; k += 3) expected.push_back(k);
  for (int k = 0; k < 60; ++k)
    if (k % 3 != 0) expected.push_back(k);
  expect_order_of("60 rows at two heights", order_along(heights), expected, {},
                  "Equal heights stay in order, since the three rows of a contact belong together. Use "
                  "std::stable_sort, and a comparison that is false for equal heights: <, not <=.");
  expect_order_of("the order of heights 0, -0, -1, 0, -0", order_along({0.0, -0.0, -1, 0.0, -0.0}),
                  {2, 0, 1, 3, 4}, {}, "0 and -0 are equal heights, and stay in order.");
}

EXERCISE_TEST(OrderAlong, PutsANaNLast) {
  const double nan = std::nan("");
  expect_order_of(
      "the order of heights 2, NaN, 1, NaN, 3, 0", order_along({2, nan, 1, nan, 3, 0}), {5, 2, 0, 4, 1, 3}, {},
      "Every comparison with NaN is false, and a sort by < alone leaves the others unsorted around it. "
      "Compare so that a NaN is above every number.");
  expect_order_of(
      "the order of heights NaN, ∞, 1, -∞", order_along({nan, infinity, 1, -infinity}), {3, 2, 1, 0},
      {{as_eigen(std::vector<int>{3, 2, 0, 1}),
        "A NaN is higher than any, ∞ as well: it is not to be taken for ∞."}},
      "A NaN is higher than any. Infinities are heights like others: -∞ is the lowest, and ∞ is below NaN.");
  expect_true("no rows have an empty order", "Eq. (10.3)", order_along({}).empty());
}

EXERCISE_TEST(RandomOrder, HasEachIndexOnce) {
  std::mt19937_64 generator(Random::seed());
  for (const int n : {0, 1, 2, 3, 10, 1000}) {
    const auto order = random_order(n, generator);
    expect_true("a random order of " + std::to_string(n) + " has each index once, from 0", "Eq. (10.4)",
                has_each_once(order, n), "From 0 to n - 1, none twice and none left out.");
  }
}

// χ² over the 24 orders of four, which are equally likely.
EXERCISE_TEST(RandomOrder, MakesEveryOrderAsLikely) {
  std::mt19937_64 generator(Random::seed());
  const int draws = 24000, orders = 24;
  std::map<std::vector<int>, int> seen;
  for (int k = 0; k < draws; ++k) ++seen[random_order(4, generator)];
  expect_near(
      "how many of the 24 orders of four occur in 24,000 draws", "Eq. (10.4)", static_cast<double>(seen.size()),
      orders, {0, "1,000 draws are expected of each"},
      {{6, "Only six occur: the cycles through all four. An element must also be able to stay where it is."},
       {4, "Only four occur: a random start, and then round in order."},
       {12, "Only twelve occur, one half: the last exchange, of the last two, is missing."},
       {1, "The order is always the same: the generator is unused, or starts afresh in each call."}},
      "Some never occur: every index that is not yet placed must be possible at every place.");
  double chi2 = 0;
  const double expected = static_cast<double>(draws) / orders;
  for (const auto& [order, count] : seen) chi2 += (count - expected) * (count - expected) / expected;
  expect_at_most(
      "χ² of how often each occurs, 23 degrees of freedom", "Eq. (10.4)", chi2, 80,
      "1 in 30 million for a fair order",
      "Some orders are more likely than others. Exchanging every element with any of all n gives nⁿ equally "
      "likely ways to n! orders, which cannot be fair. Exchange with elements that are not yet placed.");
}

// In a random order of any number of rows, the first of two neighbours is the lower one half of the times.
EXERCISE_TEST(RandomOrder, IsAsRandomForManyRows) {
  std::mt19937_64 generator(Random::seed());
  const int n = 100000;
  const auto order = random_order(n, generator);
  int rises = 0;
  for (std::size_t k = 1; k < order.size(); ++k) rises += order[k - 1] < order[k];
  expect_near("fraction of neighbours that rise, in a random order of 100,000", "Eq. (10.4)",
              static_cast<double>(rises) / n, 0.5, {0.006, "6.5 times √(1/(12 n))"}, {},
              "Are there as many random numbers as there are rows? If they are drawn from too few, many are "
              "equal, and rows with equal numbers stay in order.");
}

// The place of an index is 0 to n - 1, all equally likely: the mean is (n - 1)/2, the deviation n/√12.
EXERCISE_TEST(RandomOrder, TakesEveryIndexAnywhere) {
  std::mt19937_64 generator(Random::seed());
  const int n = 1000, draws = 300;
  Eigen::VectorXd place = Eigen::VectorXd::Zero(n);
  for (int draw = 0; draw < draws; ++draw) {
    const auto order = random_order(n, generator);
    expect_true("a random order of 1000 has each index once", "Eq. (10.4)", has_each_once(order, n));
    if (!has_each_once(order, n)) return;
    for (int k = 0; k < n; ++k) place[order[static_cast<std::size_t>(k)]] += static_cast<double>(k) / draws;
  }
  for (const int k : {0, 1, 100, 300, 500, 900, 998, 999})
    expect_near(
        "the mean place of index " + std::to_string(k) + " in " + std::to_string(draws) +
            " random orders of 1000",
        "Eq. (10.4)", place[k], (n - 1) / 2.0,
        {6 * n / std::sqrt(12.0 * draws), "six times n/√12 over the root of the draws"}, {},
        "Any index may come to any place, for any number of rows. Is a random number as large as n possible?");
}

EXERCISE_TEST(RandomOrder, ComesFromTheGenerator) {
  std::mt19937_64 one(Random::seed()), same(Random::seed());
  const auto first = random_order(50, one), again = random_order(50, same);
  expect_true("two generators in the same state give the same order of 50", "Eq. (10.4)", first == again,
              "A run must be repeatable: take chance from the given generator, and from nothing else.");
  expect_true("and leave both generators in the same, new state", "Eq. (10.4)",
              one == same && one != std::mt19937_64(Random::seed()),
              "The generator's state has not changed: is it a copy, or another one?");
  expect_true("the next order of 50 differs", "Eq. (10.4)", random_order(50, one) != first,
              "Take the generator by reference, so that its state continues from call to call.");
}

template <int Dof>
Problem<Dof> in_order(const Problem<Dof>& p, const std::vector<int>& order) {
  Problem<Dof> other = p;
  for (std::size_t k = 0; k < order.size(); ++k) other.rows[k] = p.rows[static_cast<std::size_t>(order[k])];
  return other;
}

Eigen::VectorXd put_back(const Eigen::VectorXd& values, const std::vector<int>& order) {
  Eigen::VectorXd back(values.size());
  for (std::size_t k = 0; k < order.size(); ++k) back[order[k]] = values[static_cast<Eigen::Index>(k)];
  return back;
}

EXERCISE_TEST(SweepInOrder, UpdatesTheRowsInThatOrder) {
  Random random;
  Problem<6> p = random_problem(random, 3, 7);
  for (auto& row : p.rows) row.lo = -infinity;
  const std::vector<int> order = {3, 5, 0, 6, 2, 1, 4};
  const Problem<6> start = p;
  const double returned = sweep_in_order(order, p.rows, p.V);

  const auto swept = [&](const std::vector<int>& some) {
    Problem<6> other = in_order(start, some);
    sweep(other.rows, other.V);
    return put_back(lambdas(other), some);
  };
  std::vector<int> given(7), inverse(7);
  for (std::size_t k = 0; k < 7; ++k) {
    given[k] = static_cast<int>(k);
    inverse[static_cast<std::size_t>(order[k])] = given[k];
  }
  const std::vector<int> backwards(order.rbegin(), order.rend());
  Problem<6> moved_rows = in_order(start, order);
  sweep(moved_rows.rows, moved_rows.V);
  Eigen::VectorXd jacobi(7);
  for (Eigen::Index k = 0; k < 7; ++k) {
    const Row<6>& row = start.rows[static_cast<std::size_t>(k)];
    jacobi[k] = row.B / row.diagonal;
  }
  const std::string what = "λ of seven coupled rows, swept in the order 3 5 0 6 2 1 4 [N s]";
  expect_near_vector(
      what, "Eq. (4.9)", lambdas(p), swept(order), roundings(1000, 10),
      {{swept(given), "They were swept as listed: the order was not used."},
       {swept(inverse), "The order says which row comes first, and not at which place row 0 comes."},
       {swept(backwards), "This is the order backwards."},
       {lambdas(moved_rows),
        "The rows have changed places. Other functions refer to them by index: leave them in place."},
       {jacobi, "This is Jacobi's iteration: each row must use the updates of the rows before it."},
       {lambdas(start), "No row has changed."}});
  Problem<6> other = in_order(start, order);
  Problem<6> by_hand = start;
  double of_places = 0;  // the largest, with the diagonals in the order of the rows
  for (std::size_t n = 0; n < order.size(); ++n) {
    Row<6>& row = by_hand.rows[static_cast<std::size_t>(order[n])];
    of_places = std::max(of_places, by_hand.rows[n].diagonal * std::abs(update_row(row, by_hand.V)));
  }
  expect_near(
      "what that sweep returns [m/s]", "Eq. (4.9)", returned, sweep(other.rows, other.V), roundings(100, 10),
      {{of_places,
        "This multiplies Δλ of one row by S_kk of another: both are those of the row that is updated."}},
      "As sweep() does: the largest S_kk |Δλ_k|.");
  Problem<6> second = start;
  sweep_in_order(backwards, second.rows, second.V);
  expect_near_vector(
      "λ of the same rows, swept afterwards in the order 4 1 2 6 0 5 3 [N s]", "Eq. (4.9)", lambdas(second),
      swept(backwards), roundings(1000, 10),
      {{swept(order), "This is the order of the call before: is it kept in a static variable?"}});
}

EXERCISE_TEST(SweepInOrder, IsSweepInTheOrderGiven) {
  Random random;
  Problem<6> p = random_problem(random, 4, 10), expected = p;
  std::vector<int> order(10);
  std::iota(order.begin(), order.end(), 0);
  for (int n = 1; n <= 3; ++n) {
    const double returned = sweep_in_order(order, p.rows, p.V), should = sweep(expected.rows, expected.V);
    double impulse = 0;
    for (const auto& row : p.rows) impulse = std::max(impulse, row.lambda);
    expect_near("what sweep " + std::to_string(n) + " in the order 0, 1, 2 ... returns [m/s]", "Eq. (4.9)",
                returned, should, roundings(100, 10),
                {{n == 1 ? impulse : std::nan(""),
                  "This is the largest |Δλ|, an impulse. Times S_kk it is a velocity."}},
                "Return the largest S_kk |Δλ_k|, as sweep() does, also of a row whose λ decreases, Δλ < 0.");
  }
  expect_near_vector("λ after three sweeps of ten contacts [N s]", "Eq. (4.7)", lambdas(p), lambdas(expected),
                     roundings(1000, 10));
  expect_near_vector("V after them [m/s, rad/s]", "Eq. (4.5)", flat(p.V), flat(expected.V),
                     roundings(1000, 10));
}

EXERCISE_TEST(SweepInOrder, TakesAnyBoundsAndAnyStart) {
  Random random;
  for (int trial = 0; trial < 20 && !::testing::Test::HasFailure(); ++trial) {
    const int rows = trial == 0 ? many : 20;
    Problem<6> p = any_rows(random, random.integer(2, 14), rows);
    const std::vector<int> order = shuffled(random, rows);
    Problem<6> expected = in_order(p, order);
    const double should = sweep(expected.rows, expected.V);
    const std::string of = std::to_string(rows) + " rows";
    expect_near("what a sweep in a random order returns, of " + of + " with bounds of all kinds [m/s]",
                "Eq. (4.9)", sweep_in_order(order, p.rows, p.V), should, roundings(100, 10), {},
                "Return the largest S_kk |Δλ_k|, also of rows that begin at either bound and leave it.");
    expect_near_vector("λ of " + of + " after a sweep in a random order; some began outside their bounds [N s]",
                       "Eq. (4.7)", lambdas(p), put_back(lambdas(expected), order), roundings(1000, 10), {},
                       "Every row is updated, also one that begins at a bound. " + ends_early);
  }
}

EXERCISE_TEST(SweepInOrder, DoesNotHideANaN) {
  Problem<3> p = stack({1, 1, 1}, 0.1);
  p.rows[1].B = std::nan("");
  p.rows[2].i = p.rows[2].j = 0;  // a row after the broken one, without NaN
  expect_true("a sweep with a NaN in one row returns NaN", "Eq. (4.9)",
              std::isnan(sweep_in_order({0, 1, 2}, p.rows, p.V)),
              "std::max(a, NaN) is a. Once the largest is NaN, no later row may replace it.");
  std::vector<Row<3>> none;
  expect_near("what a sweep of no rows returns [m/s]", "Eq. (4.9)", sweep_in_order({}, none, p.V), 0,
              {0, "exact"});
}

// The factor of a sweep without bounds and with B = 0: by how much it shrinks each unit vector.
double factor_of_sweep(Problem<3> p, const std::vector<int>& order) {
  take_bounds_off(p);
  const auto n = static_cast<Eigen::Index>(p.rows.size());
  Eigen::MatrixXd T(n, n);
  for (Row<3>& row : p.rows) row.B = 0;
  for (Eigen::Index k = 0; k < n; ++k) {
    set_lambda(p, Eigen::VectorXd::Unit(n, k));
    sweep_in_order(order, p.rows, p.V);
    T.col(k) = lambdas(p);
  }
  return spectral_radius(T);
}

EXERCISE_TEST(SweepInOrder, HasOneRateInEveryOrderOfATower) {
  Random random;
  std::vector<double> masses;
  for (int k = 0; k < 6; ++k) masses.push_back(random.log_uniform(0.3, 3));
  const Problem<3> p = stack(masses, 0.1, 0.01);
  const Eigen::MatrixXd S = dense_S(p.rows);
  const Eigen::VectorXd D = S.diagonal().cwiseSqrt().cwiseInverse();
  const Eigen::MatrixXd J = Eigen::MatrixXd::Identity(6, 6) - D.asDiagonal() * S * D.asDiagonal();
  const double jacobi = spectral_radius(J);
  for (int repeat = 0; repeat < 5; ++repeat)
    expect_near("factor of the error a sweep of a tower of six, in a random order", "Eq. (10.10)",
                factor_of_sweep(p, shuffled(random, 6)), jacobi * jacobi,
                {1e-7, "eigenvalues of a matrix that is not symmetric"},
                {{jacobi, "This is Jacobi's factor: each row must use the updates of the rows before it."}},
                "The factor is the square of Jacobi's in any order: the rows of a tower have no cycle.");
}

EXERCISE_TEST(SweepInOrder, GoingUpSavesOneSweepARow) {
  Random random;
  std::vector<double> masses;
  for (int k = 0; k < 6; ++k) masses.push_back(random.log_uniform(0.3, 3));
  const Problem<3> start = stack(masses, 0.1);
  const std::vector<int> up = {0, 1, 2, 3, 4, 5}, down = {5, 4, 3, 2, 1, 0};
  Problem<3> p = start;
  for (int n = 0; n < 4; ++n) sweep_in_order(up, p.rows, p.V);
  Problem<3> other = start;
  for (int n = 1; n <= 9; ++n) {
    sweep_in_order(down, other.rows, other.V);
    const auto k = static_cast<std::size_t>(n - 4);
    if (n >= 4)
      expect_near("λ of row " + std::to_string(k) + " after 4 sweeps up, against " + std::to_string(n) +
                      " sweeps down [N s]",
                  "Eq. (10.11)", p.rows[k].lambda, other.rows[k].lambda, roundings(200, 10), {},
                  "From λ = 0, sweeping up is ahead by k sweeps in row k, and stays ahead by k.");
  }
}

}  // namespace
