// Beyond chapter 11's own tests: one system, by every function of the chapter, against dense elimination.
#include "11_direct/direct.hpp"
#include "dense_rows.hpp"
#include "exercise_test.hpp"

using namespace spook;
using namespace spook::testing;

namespace {

EXERCISE(SchurComplement, "11.1 schur_complement");
EXERCISE(Factorise, "11.3 factorise");
EXERCISE(SaddleSolve, "11.4 saddle_solve");
EXERCISE(DirectSolve, "11.11 direct_solve");

struct Wired {
  Random random;
  Motion<6> motion;
  std::vector<Row<6>> rows;
  std::vector<Twist<6>> V;

  explicit Wired(bool bounded) {
    for (int k = 0; k < 8; ++k) {
      motion.inverse_mass.push_back(random_body(random));
      motion.W.push_back(random.twist());
      motion.Wf.push_back(random.twist(0.2));
    }
    for (int k = 0; k < 14; ++k) {
      const int i = k % 7;  // a wire, and cross links
      const Twist<6> Gi = random.twist(), Gj = random.twist();
      rows.push_back(make_row<6>({.i = i,
                                  .j = k < 7 ? i + 1 : (i + 3) % 8,
                                  .Gi = Gi,
                                  .Gj = Gj,
                                  .gap = random.uniform(-0.1, 0.1),
                                  .spook = {.a = 4, .b = 0.8, .Sigma = 0.1},
                                  .lo = bounded && k % 2 == 0 ? 0 : -infinity,
                                  .hi = bounded && k % 3 == 0 ? 0.2 : infinity},
                                 motion));
    }
    V.assign(8, Twist<6>::Zero());
  }

  Eigen::VectorXd eliminated() const { return dense_S(rows).ldlt().solve(gathered(rows, &Row<6>::B)); }
};

EXERCISE_TEST(SchurComplement, IsTheMatrixOfAnyScene) {
  const Wired t(false);
  const SparseMatrix S = schur_complement(t.rows);
  const Eigen::MatrixXd lower = Eigen::MatrixXd(S).triangularView<Eigen::Lower>();
  const Eigen::MatrixXd expected = dense_S(t.rows).triangularView<Eigen::Lower>();
  expect_near("largest difference on and below the diagonal [1/kg]", "Eq. (11.1)",
              (lower - expected).cwiseAbs().maxCoeff(), 0, roundings(200, expected.cwiseAbs().maxCoeff()));
}

EXERCISE_TEST(Factorise, SolvesWhatItWasGiven) {
  const Wired t(false);
  const Eigen::MatrixXd dense = dense_S(t.rows);
  const Eigen::MatrixXd lower = dense.triangularView<Eigen::Lower>();
  Factors factors;
  expect_true("S with Σ = 0.1 can be factorised", "Eq. (11.4)", factorise(lower.sparseView(), factors));
  const Eigen::MatrixXd nothing = Eigen::MatrixXd::Ones(2, 2).triangularView<Eigen::Lower>();
  Factors of_nothing;
  expect_true("two rows that say the same, with Σ = 0, cannot", "Eq. (11.4)",
              !factorise(nothing.sparseView(), of_nothing));
}

EXERCISE_TEST(SaddleSolve, AgreesWithElimination) {
  Wired t(false);
  const Eigen::VectorXd expected = t.eliminated();
  const double condition = dense_S(t.rows).norm() / 0.1;  // no eigenvalue is below Σ
  Factors factors;
  expect_true("it is solved", "Eq. (11.2)", saddle_solve(t.rows, t.motion.inverse_mass, t.V, factors));
  expect_near_vector("λ [N s]", "Eq. (11.2)", gathered(t.rows, &Row<6>::lambda), expected,
                     roundings(100 * condition, 1 + expected.norm()));
}

EXERCISE_TEST(DirectSolve, EndsAtASolutionWithinBounds) {
  Wired t(true);
  Factors factors;
  direct_solve(t.rows, t.V, {.max_sweeps = 100, .tolerance = 0}, factors);
  for (const Row<6>& row : t.rows)
    expect_true("λ is within its bounds", "Eq. (4.1)", row.lambda >= row.lo && row.lambda <= row.hi);
  expect_at_most("residual [m/s]", "Eq. (11.13)", residual(t.rows, t.V), 1e-11,
                 "a hundred times (11.13) for B of 1 m/s");
}

}  // namespace
