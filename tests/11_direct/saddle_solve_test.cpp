// The saddle point gives the same solution as S, from a matrix that stays sparse where S does not.
#include "algebra.hpp"
#include "exercise_test.hpp"
#include "systems.hpp"

using namespace spook;
using namespace spook::testing;

namespace {

EXERCISE(SaddleSolve, "11.4 saddle_solve");

EXERCISE_TEST(SaddleSolve, SolvesTheRows) {
  Random random;
  for (int repeat = 0; repeat < 10; ++repeat) {
    System<6> s = random_system(random, 5, 1 + 2 * repeat);
    Factors factors;
    expect_true("it has a solution", "Eq. (11.2)", saddle_solve(s.rows, s.motion.inverse_mass, s.V, factors));
    const MatrixXd S = dense_S(s.rows);
    const VectorXd B = gathered(s.rows, &Row<6>::B), expected = solution_of(S, B);
    const Tolerance tolerance{1e-12 * condition(S) * (1 + expected.norm()),
                              "round-off times the condition of S"};
    expect_near_vector("λ of S λ = B [N s]", "Eq. (11.1)", gathered(s.rows, &Row<6>::lambda), expected,
                       tolerance, {{VectorXd(-expected), "The unknown of Eq. (11.2) is -λ."}});
    expect_near("largest difference of V and M⁻¹Gᵀλ [m/s, rad/s]", "Eq. (11.2)",
                difference(s.V, velocities(s.rows, s.V.size())), 0, {10 * tolerance.value, tolerance.reason},
                {}, "Body b has the unknowns from Dof b on.");
  }
}

EXERCISE_TEST(SaddleSolve, IgnoresInitialValues) {
  Random random;
  System<6> cold = random_system(random, 4, 6), warm = cold;
  Factors factors;
  saddle_solve(cold.rows, cold.motion.inverse_mass, cold.V, factors);
  for (Row<6>& row : warm.rows) row.lambda = random.uniform(-5, 5);
  for (Twist<6>& V : warm.V) V.setConstant(random.uniform(-5, 5));
  saddle_solve(warm.rows, warm.motion.inverse_mass, warm.V, factors);
  expect_near_vector("λ from other values on entry [N s]", "Eq. (11.2)", gathered(warm.rows, &Row<6>::lambda),
                     gathered(cold.rows, &Row<6>::lambda), roundings(10, 10), {},
                     "λ and V solve Eq. (11.2), whatever they were on entry.");
  expect_near("largest difference of V [m/s, rad/s]", "Eq. (11.2)", difference(warm.V, cold.V), 0,
              roundings(10, 10), {}, "Assign V: nothing is added to what it held.");
}

EXERCISE_TEST(SaddleSolve, KnowsNoBounds) {
  Random random;
  System<6> s = random_system(random, 4, 6), held = s;
  for (Row<6>& row : held.rows) row.lo = row.hi = 0;
  Factors factors;
  saddle_solve(s.rows, s.motion.inverse_mass, s.V, factors);
  saddle_solve(held.rows, held.motion.inverse_mass, held.V, factors);
  expect_near_vector("λ of rows with bounds [N s]", "Eq. (11.2)", gathered(held.rows, &Row<6>::lambda),
                     gathered(s.rows, &Row<6>::lambda), roundings(10, 10), {},
                     "The rows are solved as if they had none.");
}

EXERCISE_TEST(SaddleSolve, HoldsAHangingWire) {
  const HangingWire wire{.links = 30, .ratio = 1000, .k = 1e6, .h = 0.01};
  System<3> s = wire.system();
  Factors factors;
  expect_true("it has a solution", "Eq. (11.2)", saddle_solve(s.rows, s.motion.inverse_mass, s.V, factors));
  for (int link = 0; link < wire.links; ++link)
    expect_near("λ of link " + std::to_string(link) + " [N s]", "Eq. (11.2)",
                s.rows[static_cast<std::size_t>(link)].lambda, -wire.h * wire.tension(link),
                {1e-9 * wire.h * wire.tension(0), "1e-16 times masses of 1e3, Σ of 1e-3 and 30 links"});
  for (std::size_t point = 1; point < s.V.size(); ++point)
    expect_near("V of point " + std::to_string(point) + ", which holds it against gravity [m/s]", "Eq. (11.2)",
                s.V[point].z(), wire.h * wire.g, {1e-9, "as λ"});
}

EXERCISE_TEST(SaddleSolve, TakesAnyNumberOfRows) {
  Random random;
  System<3> s = star(random, 400);
  Factors factors;
  expect_true("it has a solution", "Eq. (11.2)", saddle_solve(s.rows, s.motion.inverse_mass, s.V, factors));
  const std::string clue = "Solve for every row and every body, however many there are.";
  double lacks = 0;
  for (const Row<3>& row : s.rows)
    lacks = std::max(
        lacks, std::abs(row.B - row.Gi.dot(s.V[row.i]) - row.Gj.dot(s.V[row.j]) - row.Sigma * row.lambda));
  expect_near("the largest residual of 400 rows [m/s]", "Eq. (11.2)", lacks, 0, {1e-9, "roundings"}, {}, clue);
  expect_near("largest difference of V and M⁻¹Gᵀλ of 401 bodies [m/s]", "Eq. (11.2)",
              difference(s.V, velocities(s.rows, s.V.size())), 0, {1e-9, "roundings"}, {}, clue);
}

EXERCISE_TEST(SaddleSolve, AStarStaysSparse) {
  Random random;
  std::vector<double> entries;
  for (const int points : {100, 200, 400}) {
    System<3> s = star(random, points);
    Factors factors;
    saddle_solve(s.rows, s.motion.inverse_mass, s.V, factors);
    entries.push_back(static_cast<double>(factors.ldlt.matrixL().nestedExpression().nonZeros()));
    // The Schur complement of the same star has n(n+1)/2 entries, and no order helps.
    expect_at_most("entries of L for a star of " + std::to_string(points) + " points", "Eq. (11.2)",
                   entries.back(), 20 * points,
                   "each row touches six velocities, and few entries are filled in",
                   "Is the matrix of Eq. (11.2) the one that is factorised?");
  }
  expect_near("entries of L for 400 points over those for 200", "Eq. (11.2)", entries[2] / entries[1], 2,
              {0.1, "proportional, except for the middle"});
}

EXERCISE_TEST(SaddleSolve, AFailureLeavesAllAsItWas) {
  Random random;
  for (int repeat = 0; repeat < 10; ++repeat) {
    System<6> s = random_system(random, 3, 2);
    for (Row<6>& row : s.rows) row.Sigma = 0, row.lambda = 7;
    s.rows[1].Gi = s.rows[0].Gi, s.rows[1].Gj = s.rows[0].Gj;
    s.rows[1].i = s.rows[0].i, s.rows[1].j = s.rows[0].j;
    for (Twist<6>& V : s.V) V.setConstant(3);
    Factors factors;
    expect_true("the same row twice, with Σ = 0: no solution", "Eq. (11.4)",
                !saddle_solve(s.rows, s.motion.inverse_mass, s.V, factors),
                "factorise says whether it went well: return that.");
    expect_near_vector("λ after that [N s]", "Eq. (11.4)", gathered(s.rows, &Row<6>::lambda),
                       VectorXd::Constant(2, 7), {0, "exact"}, {},
                       "Change nothing before factorise has succeeded.");
    expect_near("largest change of V after that [m/s, rad/s]", "Eq. (11.4)",
                difference(s.V, std::vector<Twist<6>>(3, Twist<6>::Constant(3))), 0, {0, "exact"}, {},
                "Change nothing before factorise has succeeded.");
  }
}

EXERCISE_TEST(SaddleSolve, OfNoRowsMovesNothing) {
  Random random;
  System<6> s = random_system(random, 3, 0);
  for (Twist<6>& V : s.V) V.setConstant(3);
  Factors factors;
  expect_true("no rows: it has a solution", "Eq. (11.2)",
              saddle_solve(s.rows, s.motion.inverse_mass, s.V, factors));
  expect_near("largest V [m/s, rad/s]", "Eq. (11.2)",
              difference(s.V, std::vector<Twist<6>>(3, Twist<6>::Zero())), 0, {0, "exact"}, {},
              "V is set for every body. Without a row on it, it is 0, whatever it was.");
}

}  // namespace
