// Beyond chapter 10's own tests: orders are permutations, nearest matches, bounds of every kind.
#include <algorithm>
#include <numbers>
#include <numeric>

#include "10_convergence/convergence.hpp"
#include "algebra.hpp"
#include "dense_rows.hpp"
#include "exercise_test.hpp"
#include "stop_rule.hpp"

using namespace spook;
using namespace spook::testing;

namespace {

EXERCISE(MatchContacts, "10.1 match_contacts");
EXERCISE(WarmStart, "10.2 warm_start");
EXERCISE(OrderAlong, "10.3 order_along");
EXERCISE(RandomOrder, "10.4 random_order");
EXERCISE(SweepInOrder, "10.5 sweep_in_order");
EXERCISE(ObservedRate, "10.6 observed_rate");
EXERCISE(Precondition, "10.7 precondition");
EXERCISE(ConjugateSolve, "10.8 conjugate_solve");
EXERCISE(Relax, "10.9 relax");
EXERCISE(SoftParameters, "10.10 soft_parameters");
EXERCISE(UpdateSoftRow, "10.11 update_soft_row");
EXERCISE(SoftSubstep, "10.12 soft_substep");

EXERCISE_TEST(MatchContacts, FollowsAContactThatMoves) {
  Random random;
  std::vector<Contact> contacts;
  std::vector<OldContact> old;
  const Vec3 moved = random.vector_of_length(0.01, 0.02);
  for (int k = 0; k < 30; ++k) {
    const Vec3 r(k, 0, 0);
    contacts.push_back({.i = k % 3, .j = 3 + k % 2, .n = Vec3::UnitZ(), .gap = 0, .r_i = -r, .r_j = r});
    old.insert(old.begin(), {.i = k % 3, .j = 3 + k % 2, .point = r + moved});
  }
  const std::vector<int> found = match_contacts(contacts, old, 0.1);
  bool right = found.size() == 30;
  for (int k = 0; right && k < 30; ++k) right = found[static_cast<std::size_t>(k)] == 29 - k;
  expect_true("contact k continues the old contact 29 - k", "Eq. (10.1)", right);
}

EXERCISE_TEST(OrderAlong, SortsAnyHeights) {
  Random random;
  std::vector<double> heights(many);
  for (double& height : heights) height = random.uniform(-5, 5);
  const std::vector<int> order = order_along(heights);
  bool sorted = order.size() == heights.size() && std::is_permutation(order.begin(), order.end(),
                                                                      [] {
                                                                        std::vector<int> all(many);
                                                                        std::iota(all.begin(), all.end(), 0);
                                                                        return all;
                                                                      }()
                                                                          .begin());
  for (std::size_t k = 1; sorted && k < order.size(); ++k)
    sorted = heights[static_cast<std::size_t>(order[k - 1])] <= heights[static_cast<std::size_t>(order[k])];
  expect_true("it is an order of all rows, by height", "Eq. (10.3)", sorted);
}

EXERCISE_TEST(RandomOrder, IsAnOrderOfAllRows) {
  std::mt19937_64 generator(Random::seed());
  for (const int n : {1, 2, 17, many}) {
    std::vector<int> order = random_order(n, generator);
    std::sort(order.begin(), order.end());
    std::vector<int> all(static_cast<std::size_t>(n));
    std::iota(all.begin(), all.end(), 0);
    expect_true("each of " + std::to_string(n) + " rows is in it once", "Eq. (10.4)", order == all);
  }
}

EXERCISE_TEST(ObservedRate, FindsTheRateOfAnyDecay) {
  Random random;
  for (int k = 0; k < 20; ++k) {
    const double rate = random.uniform(0.3, 0.99);
    const int sweeps = random.integer(6, 60);
    std::vector<double> history = {random.log_uniform(1e-3, 1e3)};
    while (std::ssize(history) < sweeps) history.push_back(history.back() * rate);
    expect_near("ρ", "Eq. (10.5)", observed_rate(history), rate, roundings(100));
  }
}

EXERCISE_TEST(ConjugateSolve, AgreesWithElimination) {
  Random random;
  Motion<6> motion;
  for (int k = 0; k < 5; ++k) {
    motion.inverse_mass.push_back(random_body(random));
    motion.W.push_back(random.twist());
    motion.Wf.push_back(random.twist(0.2));
  }
  std::vector<Row<6>> rows;
  for (int k = 0; k < 12; ++k) {
    const int i = random.integer(0, 4);
    const int j = (i + random.integer(1, 4)) % 5;
    const Twist<6> Gi = random.twist(), Gj = random.twist();
    rows.push_back(make_row<6>({.i = i,
                                .j = j,
                                .Gi = Gi,
                                .Gj = Gj,
                                .gap = random.uniform(-0.1, 0.1),
                                .spook = {.a = 4, .b = 0.8, .Sigma = 0.5},
                                .lo = -infinity,
                                .hi = infinity},
                               motion));
  }
  std::vector<Twist<6>> V(5, Twist<6>::Zero());
  const Eigen::MatrixXd S = dense_S(rows);
  const Eigen::VectorXd expected = solution_of(S, gathered(rows, &Row<6>::B));
  conjugate_solve(rows, V, {.max_sweeps = 200, .tolerance = 1e-12});
  // No eigenvalue of S is below Σ = 0.5, and no residual is above n S/min(S_kk) times the tolerance.
  expect_near_vector(
      "λ [N s]", "Eq. (10.8)", gathered(rows, &Row<6>::lambda), expected,
      {12 * S.norm() / S.diagonal().minCoeff() * 1e-12 / 0.5, "the tolerance, as S carries it on"});
}

/// Rows between five bodies, with bounds of every kind or none.
struct Bound {
  Random random;
  Motion<6> motion;
  std::vector<Row<6>> rows;
  std::vector<Twist<6>> V;

  Bound(int count, bool bounds) {
    for (int k = 0; k < 5; ++k) {
      motion.inverse_mass.push_back(random_body(random));
      motion.W.push_back(random.twist());
      motion.Wf.push_back(random.twist(0.2));
      V.push_back(random.twist());
    }
    for (int k = 0; k < count; ++k) {
      const int i = random.integer(0, 4), step = random.integer(1, 4);
      const Twist<6> Gi = random.twist(), Gj = random.twist();
      rows.push_back(make_row<6>({.i = i,
                                  .j = (i + step) % 5,
                                  .Gi = Gi,
                                  .Gj = Gj,
                                  .gap = random.uniform(-0.1, 0.1),
                                  .spook = {.a = 4, .b = 0.8, .Sigma = 0.5},
                                  .lo = -infinity,
                                  .hi = infinity},
                                 motion));
      if (bounds) give_any_bounds(random, rows.back());
    }
  }
};

void expect_same_rows(const std::string& equation, const Bound& got, const Bound& expected, double tolerance) {
  for (std::size_t k = 0; k < got.rows.size(); ++k)
    expect_near("λ of row " + std::to_string(k) + " [N s]", equation, got.rows[k].lambda,
                expected.rows[k].lambda, {tolerance, "roundings of the rows before"});
  for (std::size_t b = 0; b < got.V.size(); ++b)
    expect_near_vector("V of body " + std::to_string(b), equation, got.V[b], expected.V[b],
                       {10 * tolerance, "roundings of the rows before"});
}

EXERCISE_TEST(MatchContacts, TakesTheNearestOfTheSamePair) {
  Random random;
  for (int n = 0; n < 20; ++n) {
    std::vector<Contact> contacts;
    std::vector<OldContact> old;
    for (int k = 0; k < 12; ++k) {
      const int i = random.integer(0, 1), j = random.integer(2, 3);
      const Vec3 r = random.vector(0.2), p = random.vector(0.2);
      contacts.push_back({.i = i, .j = j, .n = Vec3::UnitZ(), .gap = 0, .r_i = random.vector(), .r_j = r});
      old.push_back({.i = random.integer(0, 1), .j = j, .point = p});
    }
    const double reach = 0.15;
    std::vector<int> expected(contacts.size(), -1);
    std::vector<bool> taken(old.size(), false);
    for (;;) {  // the nearest of all pairs that are left
      double nearest = infinity;
      std::size_t at = 0, from = 0;
      for (std::size_t c = 0; c < contacts.size(); ++c)
        for (std::size_t o = 0; o < old.size(); ++o) {
          const double distance = (contacts[c].r_j - old[o].point).norm();
          if (expected[c] >= 0 || taken[o] || old[o].i != contacts[c].i || old[o].j != contacts[c].j ||
              distance >= nearest)
            continue;
          nearest = distance, at = c, from = o;
        }
      if (!(nearest <= reach)) break;
      expected[at] = static_cast<int>(from);
      taken[from] = true;
    }
    expect_true("each contact continues the nearest old one of its pair, which no nearer one has taken",
                "Eq. (10.1)", match_contacts(contacts, old, reach) == expected);
  }
}

EXERCISE_TEST(WarmStart, AppliesClampedImpulses) {
  Bound t(many, true);
  for (Row<6>& row : t.rows) row.lambda = t.random.uniform(-1, 1);  // of an earlier solve, to be forgotten
  Bound expected = t;
  std::vector<double> impulses;
  for (std::size_t k = 0; k < t.rows.size(); ++k) impulses.push_back(t.random.uniform(-1, 1));
  for (Twist<6>& velocity : expected.V) velocity.setZero();
  for (std::size_t k = 0; k < t.rows.size(); ++k) {
    Row<6>& row = expected.rows[k];
    row.lambda = std::max(row.lo, std::min(row.hi, impulses[k]));
    expected.V[static_cast<std::size_t>(row.i)] += row.lambda * row.MinvGi;
    expected.V[static_cast<std::size_t>(row.j)] += row.lambda * row.MinvGj;
  }
  warm_start(impulses, t.rows, t.V);
  expect_same_rows("Eq. (10.2)", t, expected, 1e-13);
  impulses.pop_back();
  expect_rejects(
      "an impulse too few", "number of impulses", [&] { warm_start(impulses, t.rows, t.V); }, "",
      state_of(t.rows, t.V));
}

EXERCISE_TEST(OrderAlong, PutsEqualHeightsAsTheyWere) {
  const std::vector<double> heights = {2, 1, 2, 1, std::nan(""), 0, 1};
  expect_true("equal heights keep their order, and a NaN is last", "Eq. (10.3)",
              order_along(heights) == std::vector<int>{5, 1, 3, 6, 0, 2, 4});
  expect_true("no rows have an empty order", "Eq. (10.3)", order_along({}).empty());
}

EXERCISE_TEST(RandomOrder, TakesEveryOrderAlikeOften) {
  std::mt19937_64 generator(Random::seed());
  std::vector<int> count(6, 0);
  for (int k = 0; k < 6000; ++k) {
    const std::vector<int> order = random_order(3, generator);
    if (order.size() == 3) ++count[static_cast<std::size_t>(2 * order[0] + (order[1] > order[2]))];
  }
  for (const int found : count)  // the deviation of each is √(6000 · 1/6 · 5/6), 29
    expect_near("how often one of the six orders of three rows came, of 6000", "Eq. (10.4)", found, 1000,
                {200, "seven deviations"});
}

EXERCISE_TEST(SweepInOrder, IsItsUpdatesInThatOrder) {
  Bound t(80, true);
  Bound expected = t;
  std::vector<int> order(80);
  for (int k = 0; k < 80; ++k) order[static_cast<std::size_t>(k)] = (37 * k + 5) % 80;
  double most = 0;
  for (const int k : order) {
    Row<6>& row = expected.rows[static_cast<std::size_t>(k)];
    most = std::max(most, row.diagonal * std::abs(update_row(row, expected.V)));
  }
  expect_near("the largest change, which is returned [m/s]", "Eq. (10.3)", sweep_in_order(order, t.rows, t.V),
              most, {1e-10, "roundings of a sweep"});
  expect_same_rows("Eq. (10.3)", t, expected, 1e-10);
  t.rows[7].B = std::nan("");
  expect_true("a NaN stays one", "Eq. (4.9)", std::isnan(sweep_in_order(order, t.rows, t.V)));
}

EXERCISE_TEST(ObservedRate, IsOfTheSecondHalf) {
  expect_near("ρ where the first half is slow", "Eq. (10.5)", observed_rate({8, 7, 6, 3, 1.5, 0.75}), 0.5,
              roundings(16));
  for (const std::vector<double>& none : {std::vector<double>{}, {1}, {1, 0}, {0, 1}, {1, std::nan("")}})
    expect_true("there is no rate of " + std::to_string(none.size()) + " sweeps that end so", "Eq. (10.5)",
                std::isnan(observed_rate(none)));
}

EXERCISE_TEST(Precondition, IsASweepThereAndBack) {
  Bound t(many, false);
  std::vector<double> r;
  std::vector<bool> free;
  for (std::size_t k = 0; k < t.rows.size(); ++k)
    r.push_back(t.random.uniform(-1, 1)), free.push_back(k % 4 != 2);
  std::vector<Row<6>> rows = t.rows;
  for (std::size_t k = 0; k < rows.size(); ++k) rows[k].B = r[k], rows[k].lambda = 0;
  std::vector<Twist<6>> V(5, Twist<6>::Zero());
  for (std::size_t k = 0; k < rows.size(); ++k)
    if (free[k]) update_row(rows[k], V);
  for (std::size_t k = rows.size(); k-- > 0;)
    if (free[k]) update_row(rows[k], V);
  const std::vector<double> z = precondition(t.rows, r, free, 5);
  expect_true("a number for each row", "Eq. (10.6)", z.size() == rows.size());
  for (std::size_t k = 0; k < std::min(z.size(), rows.size()); ++k)
    expect_near("z of row " + std::to_string(k), "Eq. (10.6)", z[k], rows[k].lambda,
                {1e-12, "roundings of two sweeps"});
}

EXERCISE_TEST(ConjugateSolve, EndsWithinBoundsAndStopsByTheRule) {
  Bound t(8, true);
  for (Twist<6>& velocity : t.V) velocity.setZero();
  const Eigen::VectorXd expected = enumerate_solution(bounded(t.rows));
  const SolveReport report = conjugate_solve(t.rows, t.V, {.max_sweeps = 500, .tolerance = 1e-12});
  expect_true("it converges", "Eq. (4.9)", report.converged);
  expect_near_vector("λ [N s]", "Eq. (4.1)", gathered(t.rows, &Row<6>::lambda), expected,
                     {1e-9, "the tolerance, by the condition of eight rows"});
  for (const Row<6>& row : t.rows)
    expect_true("λ is within its bounds", "Eq. (4.1)", row.lambda >= row.lo && row.lambda <= row.hi);
  const auto state = state_of(t.rows, t.V);
  expect_rejects(
      "max_sweeps = 0", "max_sweeps", [&] { conjugate_solve(t.rows, t.V, {.max_sweeps = 0}); }, "", state);
  expect_rejects(
      "tolerance = -1", "tolerance", [&] { conjugate_solve(t.rows, t.V, {.tolerance = -1}); }, "", state);
  std::vector<Row<6>> none;
  expect_true("no rows are solved", "Eq. (4.9)", conjugate_solve(none, t.V, {}).converged);
}

EXERCISE_TEST(Relax, SolvesRowsWithoutGapAndSoftness) {
  Bound t(many, true);
  for (Row<6>& row : t.rows) row.lambda = t.random.uniform(-0.1, 0.1);
  Bound expected = t;
  const StopRule stop{.max_sweeps = 4, .tolerance = 0};
  std::vector<Row<6>> rigid = expected.rows;
  for (Row<6>& row : rigid) {
    const auto i = static_cast<std::size_t>(row.i), j = static_cast<std::size_t>(row.j);
    row.B = -row.Gi.dot(t.motion.W[i] + t.motion.Wf[i]) - row.Gj.dot(t.motion.W[j] + t.motion.Wf[j]);
    row.diagonal -= row.Sigma;
    row.Sigma = 0;
  }
  const SolveReport by_hand = solve(rigid, expected.V, stop);
  for (std::size_t k = 0; k < rigid.size(); ++k) expected.rows[k].lambda = rigid[k].lambda;
  const SolveReport report = relax(t.motion, t.rows, t.V, stop);
  expect_same_rows("Eq. (10.15)", t, expected, 1e-9);
  expect_true("it makes as many sweeps", "Eq. (4.9)", report.history.size() == by_hand.history.size());
  for (std::size_t k = 0; k < t.rows.size(); ++k)
    expect_true("row " + std::to_string(k) + " keeps its B, Σ and diagonal", "Eq. (10.15)",
                t.rows[k].B == expected.rows[k].B && t.rows[k].Sigma == expected.rows[k].Sigma &&
                    t.rows[k].diagonal == expected.rows[k].diagonal);
}

// One update of a row that has no bounds is a step of implicit Euler of an oscillator with S = 1.
EXERCISE_TEST(SoftParameters, MakeAStepOfImplicitEuler) {
  Random random;
  for (int k = 0; k < 20; ++k) {
    const double h = random.log_uniform(1e-4, 0.1), frequency = random.log_uniform(1e-3, 1e4);
    const double damping = k == 0 ? 0 : random.log_uniform(1e-3, 50);
    const double hw = h * 2 * std::numbers::pi * frequency, taken = 2 * damping * hw + hw * hw,
                 denominator = 1 + taken;
    const SoftParameters soft = soft_parameters(h, frequency, damping);
    expect_near("part of a velocity that is left", "Eq. (10.20)", soft.impulse_scale * denominator, 1,
                roundings(30));
    expect_near("part of it that is taken", "Eq. (10.20)", soft.mass_scale * denominator / taken, 1,
                roundings(30));
    expect_near("velocity by a gap, times h over the gap", "Eq. (10.20)",
                soft.mass_scale * soft.bias_rate * h * denominator / (hw * hw), 1, roundings(30));
  }
  expect_rejects("a negative frequency", "frequency", [] { soft_parameters(0.1, -1, 1); });
  expect_rejects("a negative damping", "damping", [] { soft_parameters(0.1, 1, -1e-9); });
}

// The same update, by the velocity that is aimed at and the bounds of λ.
double soft_update(double h, const SoftParameters& soft, double gap, Row<6>& row, std::vector<Twist<6>>& W) {
  const auto i = static_cast<std::size_t>(row.i), j = static_cast<std::size_t>(row.j);
  const double before = row.lambda, S = row.Gi.dot(row.MinvGi) + row.Gj.dot(row.MinvGj);
  const double speed = row.Gi.dot(W[i]) + row.Gj.dot(W[j]);
  if (row.lo == 0 && gap > 0)
    row.lambda -= (speed + gap / h) / S;
  else
    row.lambda -= soft.mass_scale * (speed + soft.bias_rate * gap) / S + soft.impulse_scale * before;
  row.lambda = std::min(row.hi, std::max(row.lo, row.lambda));
  W[i] += (row.lambda - before) * row.MinvGi;
  W[j] += (row.lambda - before) * row.MinvGj;
  return row.lambda - before;
}

/// Rows with gaps and impulses of their own: contacts, open and closed, and rows with any bounds.
struct Soft : Bound {
  double h = 0.02;
  SoftParameters soft{.bias_rate = 9, .mass_scale = 0.8, .impulse_scale = 0.2};
  std::vector<double> gaps;

  Soft() : Bound(many, true) {
    for (std::size_t k = 0; k < rows.size(); ++k) {
      if (k % 2 == 0) {
        rows[k].lo = 0;
        rows[k].hi = infinity;
      }
      rows[k].lambda = std::clamp(random.uniform(-0.1, 0.1), rows[k].lo, rows[k].hi);
      gaps.push_back(random.uniform(-0.05, 0.05));
    }
  }
};

EXERCISE_TEST(UpdateSoftRow, ChangesOneRowOfMany) {
  Soft t;
  Soft expected = t;
  for (std::size_t k = 0; k < t.rows.size(); ++k) {
    const double delta = update_soft_row(t.h, t.soft, t.gaps[k], t.rows[k], t.motion.W);
    const double right = soft_update(t.h, t.soft, t.gaps[k], expected.rows[k], expected.motion.W);
    expect_near("Δλ of row " + std::to_string(k) + " [N s]", "Eq. (10.21)", delta, right,
                {1e-9, "a sweep of rows"});
  }
  expect_same_rows("Eq. (10.21)", t, expected, 1e-9);
  for (std::size_t body = 0; body < t.motion.W.size(); ++body)
    expect_near_vector("W of body " + std::to_string(body), "Eq. (10.21)", t.motion.W[body],
                       expected.motion.W[body], {1e-9, "a sweep of rows"});
}

EXERCISE_TEST(SoftSubstep, SweepsManyRowsTwice) {
  Soft t;
  Soft expected = t;
  const std::vector<Twist<6>> moving = soft_substep(t.h, t.soft, t.motion.Wf, t.rows, t.gaps, t.motion.W);
  std::vector<Twist<6>>& W = expected.motion.W;
  for (std::size_t body = 0; body < W.size(); ++body) W[body] += expected.motion.Wf[body];
  for (const Row<6>& row : expected.rows) {
    W[static_cast<std::size_t>(row.i)] += row.lambda * row.MinvGi;
    W[static_cast<std::size_t>(row.j)] += row.lambda * row.MinvGj;
  }
  for (std::size_t k = 0; k < expected.rows.size(); ++k)
    soft_update(t.h, t.soft, expected.gaps[k], expected.rows[k], W);
  const std::vector<Twist<6>> between = W;
  for (std::size_t k = 0; k < expected.rows.size(); ++k) {
    const Row<6>& row = expected.rows[k];
    expected.gaps[k] +=
        t.h * (row.Gi.dot(W[static_cast<std::size_t>(row.i)]) + row.Gj.dot(W[static_cast<std::size_t>(row.j)]));
  }
  for (std::size_t k = 0; k < expected.rows.size(); ++k)
    soft_update(t.h, {}, expected.gaps[k], expected.rows[k], W);
  expect_same_rows("Eq. (10.19)", t, expected, 1e-8);
  for (std::size_t k = 0; k < t.gaps.size(); ++k)
    expect_near("gap of row " + std::to_string(k) + " [m]", "Eq. (10.19)", t.gaps[k], expected.gaps[k],
                {1e-8, "two sweeps of rows"});
  for (std::size_t body = 0; body < W.size(); ++body) {
    expect_near_vector("W of body " + std::to_string(body) + " between the sweeps", "Eq. (10.19)",
                       moving.at(body), between[body], {1e-8, "two sweeps of rows"});
    expect_near_vector("W of body " + std::to_string(body) + " after both", "Eq. (10.15)", t.motion.W[body],
                       W[body], {1e-8, "two sweeps of rows"});
  }
}

}  // namespace
