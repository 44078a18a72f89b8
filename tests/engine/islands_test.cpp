// Islands, their width, and the solver for each.
#include "engine/solvers/islands.hpp"
#include "engine/solvers/factor_cost.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "11_direct/direct.hpp"
#include "engine/world/world.hpp"
#include "raw_system.hpp"

namespace spook::islands_test {
namespace {

constexpr double h = 1.0 / 60, g = 9.81;

/// Points of 1 kg, except for those of infinite mass, with rows along x between them.
struct Net {
  Motion<3> motion;
  std::vector<Row<3>> rows;
  std::vector<Twist<3>> V;

  int add_point(double inverse_mass = 1) {
    motion.inverse_mass.push_back({inverse_mass});
    motion.W.push_back(Twist<3>::Zero());
    motion.Wf.push_back(inverse_mass > 0 ? Twist<3>(h * g, 0, 0) : Twist<3>::Zero());
    V.push_back(Twist<3>::Zero());
    return static_cast<int>(V.size()) - 1;
  }
  void join(int i, int j) {
    rows.push_back(make_row<3>({.i = i,
                                .j = j,
                                .Gi = -Twist<3>::UnitX(),
                                .Gj = Twist<3>::UnitX(),
                                .gap = 0.01 * static_cast<double>(rows.size()),
                                .spook = spook_parameters(h, 1e6, 3),
                                .lo = -infinity,
                                .hi = infinity},
                               motion));
  }
  /// Hangs so many points on `on`, one below the other.
  void hang(int on, int points, double inverse_mass = 1) {
    for (int n = 0; n < points; ++n) {
      const int next = add_point(inverse_mass);
      join(on, next);
      on = next;
    }
  }
};

TEST(Islands, ConnectRowsThroughDynamicBodies) {
  Net net;
  const int anchor = net.add_point(0);
  net.hang(anchor, 2);
  net.hang(anchor, 3);  // another island: a static body couples nothing
  const int free = net.add_point(), other = net.add_point();
  net.join(free, other);
  net.join(2, free);  // makes one island of the first and the last
  const std::vector<std::vector<int>> all = islands(net.rows, net.V.size());
  EXPECT_EQ(all, (std::vector<std::vector<int>>{{0, 1, 5, 6}, {2, 3, 4}}));
  EXPECT_TRUE(islands(std::vector<Row<3>>{}, 3).empty());
}

TEST(Islands, ARowOfFixedBodiesIsOneOfItsOwn) {
  Net net;
  const int a = net.add_point(0), b = net.add_point(0);
  net.join(a, b);
  net.hang(a, 1);
  EXPECT_EQ(islands(net.rows, net.V.size()), (std::vector<std::vector<int>>{{0}, {1}}));
}

TEST(Islands, HaveAFactorCostByTheirWidth) {
  Net wire;
  wire.hang(wire.add_point(0), 50);
  EXPECT_EQ(factor_cost(wire.rows), 2 * 2 / 25.0);

  // k rails with a rung each at every step: a level has k rails and k - 1 rungs, from end to end.
  Net ribbon;
  const int k = 4;
  std::vector<int> last;
  for (int rail = 0; rail < k; ++rail) last.push_back(ribbon.add_point());
  for (int step = 0; step < 30; ++step) {
    for (int& rail : last) {
      const int next = ribbon.add_point();
      ribbon.join(rail, next);
      rail = next;
    }
    for (int rail = 1; rail < k; ++rail) ribbon.join(last[rail - 1], last[rail]);
  }
  // Levels are counted from a corner, and so they are diagonal: two of them still have as many rails and rungs.
  EXPECT_GE(factor_cost(ribbon.rows), std::pow(2 * k - 1, 2) / 25);
  EXPECT_LE(factor_cost(ribbon.rows), std::pow(2 * (2 * k - 1), 2) / 25);
}

TEST(Islands, FactoriseBodiesWhenRowsOutnumberThem) {
  Net pair;
  const int a = pair.add_point(0), b = pair.add_point();
  const auto join = [&](int rows) {
    for (int n = 0; n < rows; ++n) pair.join(a, b);
  };
  join(6);  // of the three velocities of b, twice
  EXPECT_FALSE(wants_bodies(pair.rows));
  join(1);
  EXPECT_TRUE(wants_bodies(pair.rows));
  // All rows in one level, of one body: w = 3 velocities of 3, and 7 rows to sweep.
  EXPECT_DOUBLE_EQ(factor_cost(pair.rows), 3.0 * 3 * 3 / (25 * 7));
  pair.rows.resize(4);
  EXPECT_FALSE(wants_bodies(pair.rows));
  for (Row<3>& row : pair.rows) row.lo = 0;
  EXPECT_TRUE(wants_bodies(pair.rows)) << "on rows, bounds cost factorisations";
}

/// A hub with 150 spokes: all its rows couple one body.
Net star(double inverse_mass) {
  Net net;
  const int hub = net.add_point(inverse_mass);
  for (int spoke = 0; spoke < 150; ++spoke) net.join(hub, net.add_point());
  return net;
}

Net square_grid(int n) {
  Net grid;
  std::vector<int> above;
  for (int row = 0; row < n; ++row)
    for (int column = 0; column < n; ++column) {
      const int point = grid.add_point();
      if (row > 0) grid.join(above[static_cast<std::size_t>(column)], point);
      if (column > 0) grid.join(point - 1, point);
      if (row > 0)
        above[static_cast<std::size_t>(column)] = point;
      else
        above.push_back(point);
    }
  return grid;
}

// Wide, but cheap: in a good order, the factors of a grid of n x n take some n³ multiplications, where a band of its width
// takes n⁴, and a sweep n².
TEST(Islands, CountTheFactorsOfAGrid) {
  const auto cost = [](int n, double affordable) { return factor_cost(square_grid(n).rows, affordable); };
  EXPECT_EQ(cost(10, infinity), cost(10, 1e6)) << "a bound that is affordable suffices";
  for (const int n : {20, 40}) EXPECT_LT(cost(n, 1), cost(n, infinity) / 5) << n;
  EXPECT_LT(cost(80, 1) / cost(40, 1), 3) << "in sweeps, the order is n; that of the bound is n²";
  EXPECT_GT(cost(80, infinity) / cost(40, infinity), 3.5);
}

TEST(Islands, CountFactorsOverVelocities) {
  const auto counted = [](int n) { return counted_velocity_factor_cost(square_grid(n).rows); };
  for (const int n : {20, 40}) EXPECT_LT(counted(n), velocity_factor_cost(square_grid(n).rows) / 5) << n;
  EXPECT_LT(counted(80) / counted(40), 3);
}

TEST(Islands, CountNoFactorsOfRowsWithBounds) {
  Net net = star(1);
  const double bound = factor_cost(net.rows);
  EXPECT_LT(factor_cost(net.rows, 200), bound) << "all rows on one body: n³/6 multiplications";
  net.rows.front().lo = 0;
  EXPECT_EQ(factor_cost(net.rows, 200), bound);
}

TEST(Islands, AreFactorisedWhenSweepsFail) {
  Net stiff = star(1000);
  const StopRule few{.max_sweeps = 50};
  ASSERT_GT(factor_cost(stiff.rows, few.max_sweeps), few.max_sweeps) << "sweeps are tried first";
  std::vector<Row<3>> exact = stiff.rows;
  std::vector<Twist<3>> exact_V = stiff.V;
  Factors factors;
  direct_solve(exact, exact_V, {}, factors);

  const Solver<3> solver = automatic<3>();
  for (const std::int64_t updates : {50 * 150, 0}) {
    std::vector<Row<3>> rows = stiff.rows;
    std::vector<Twist<3>> V = stiff.V;
    const SolverResult result = solve_by(solver, stiff.motion, rows, V, few);
    EXPECT_EQ(result.row_updates, updates) << "the second time the outcome is known";
    EXPECT_TRUE(result.report.converged);
    for (std::size_t k = 0; k < rows.size(); ++k)
      EXPECT_NEAR(rows[k].lambda, exact[k].lambda, 1e-12 * std::abs(exact[k].lambda)) << "row " << k;
  }
  // Where factors cost more than a hundred times the sweeps, they are not used.
  const SolverResult poor = solve_by(automatic<3>(), stiff.motion, stiff.rows, stiff.V, {.max_sweeps = 1});
  EXPECT_EQ(poor.row_updates, 150);
  EXPECT_FALSE(poor.report.converged);
}

TEST(Islands, AreSolvedAsIfAlone) {
  Net net;
  const int anchor = net.add_point(0);
  net.hang(anchor, 5);
  net.hang(anchor, 7, 100);
  std::vector<Row<3>> rows = net.rows;
  std::vector<Twist<3>> V = net.V;
  const SolverResult result = solve_by(automatic<3>(), net.motion, rows, V);
  EXPECT_TRUE(result.report.converged);
  EXPECT_EQ(result.row_updates, 0) << "both are wires: no sweeps";

  Factors factors;
  std::vector<Row<3>> whole = net.rows;
  std::vector<Twist<3>> whole_V = net.V;
  direct_solve(whole, whole_V, {}, factors);
  double largest_impulse = 0;
  for (const Row<3>& row : whole) largest_impulse = std::max(largest_impulse, std::abs(row.lambda));
  for (std::size_t k = 0; k < rows.size(); ++k)
    EXPECT_NEAR(rows[k].lambda, whole[k].lambda, 1e-13 * largest_impulse) << "row " << k;
  for (std::size_t body = 0; body < V.size(); ++body)
    EXPECT_LE((V[body] - whole_V[body]).norm(), 1e-11) << "body " << body;
}

TEST(Islands, AreEachSolvedByTheirOwnSolver) {
  Net net;
  net.hang(net.add_point(0), 5);
  const int hub = net.add_point();
  for (int spoke = 0; spoke < 60; ++spoke) net.join(hub, net.add_point());
  const SolverResult result = solve_by(automatic<3>(), net.motion, net.rows, net.V, {.max_sweeps = 20});
  EXPECT_EQ(result.row_updates, 20 * 60) << "the star is swept, the wire is not";
  EXPECT_EQ(result.report.history.size(), 21U) << "and the remainder is factorised";
}

TEST(SolverResult, AppendedHasBothHistoriesAndTheSecondsOutcome) {
  const SolverResult swept{SolveReport{.history = {3, 2}, .converged = true}};
  SolverResult direct{SolveReport{.history = {1}, .converged = false, .trouble = "why"}};
  direct.row_updates = 0;
  const SolverResult both = append(swept, direct, 10);
  EXPECT_EQ(both.report.history, (std::vector<double>{3, 2, 1}));
  EXPECT_FALSE(both.report.converged) << "the second reports it";
  EXPECT_EQ(both.report.trouble, "why");
  EXPECT_EQ(both.row_updates, 20) << "of two sweeps of 10 rows; factors have none";
  EXPECT_TRUE(append(direct, swept, 10).report.converged);
}

TEST(SolverResult, MergedIsAsGoodAsTheWorse) {
  SolverResult one{SolveReport{.history = {3, 1}, .converged = true}};
  SolverResult other{SolveReport{.history = {2, std::nan(""), 1}, .converged = false, .trouble = "why"}};
  one.row_updates = 20;
  other.row_updates = 30;
  for (const SolverResult& both : {merge_parallel(one, other), merge_parallel(other, one)}) {
    ASSERT_EQ(both.report.history.size(), 3U);
    EXPECT_EQ(both.report.history[0], 3);
    EXPECT_TRUE(std::isnan(both.report.history[1])) << "a NaN is kept beside a number";
    EXPECT_EQ(both.report.history[2], 1);
    EXPECT_FALSE(both.report.converged);
    EXPECT_EQ(both.report.trouble, "why");
    EXPECT_EQ(both.row_updates, 50);
  }
}

}  // namespace
}  // namespace spook::islands_test
