// Factors in fronts for many rows: the solution of chapter 11, or none; and S of rows whose pattern is kept.
#include "engine/solvers/frontal_direct.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "raw_system.hpp"
#include "refusals.hpp"

namespace spook::frontal_direct_test {
namespace {

/// A ladder of bodies of masses from e⁻³ to e³, the first two of which are static. Each rail and rung has a row, or as
/// many as a ball joint if bodies turn.
template <int Dof>
struct Ladder : RandomSystem<Dof> {
  Ladder(unsigned seed, int rungs, double bound = infinity) : RandomSystem<Dof>(seed) {
    this->add_light_and_heavy(2 * rungs, 2);
    const auto join = [&](int i, int j) {
      for (int n = 0; n < (Dof == 6 ? 3 : 1); ++n)
        this->add_row(i, j, spook_parameters(this->h, 1e9, 3), -bound, bound);
    };
    for (int b = 2; b < 2 * rungs; ++b) join(b - 2, b);
    for (int b = 2; b < 2 * rungs; b += 2) join(b + 1, b);
  }
};

template <int Dof>
void expect_what_chapter_11_finds() {
  // As in small_direct_test.cpp: the ratio of masses is at most e⁶, its square times ε 3.5e-11. There are up to 270
  // rows, so thirty times that; nearly all are below 1e-12.
  FrontalFactors kept;
  for (unsigned seed = 1; seed <= 40; ++seed) {
    Ladder<Dof> fronts(seed, 2 + static_cast<int>(seed) % 30), rows = fronts;
    Factors factors;
    ASSERT_TRUE(direct_solve(rows.rows, rows.V, {}, factors).converged) << "seed " << seed;
    const auto report = frontal_direct(fronts.rows, fronts.V, {}, kept);
    ASSERT_TRUE(report) << "seed " << seed;
    EXPECT_TRUE(report->converged);
    EXPECT_EQ(report->history.size(), 1U);
    EXPECT_LT(difference(fronts.rows, rows.rows), 1e-9) << "seed " << seed;
    std::vector<Twist<Dof>> V(fronts.V.size(), Twist<Dof>::Zero());
    for (const Row<Dof>& row : fronts.rows) apply_impulse(row, row.lambda, V);
    for (std::size_t b = 0; b < V.size(); ++b)
      EXPECT_LT((V[b] - fronts.V[b]).norm(), 1e-13 * (1 + V[b].norm())) << "seed " << seed << ", body " << b;
  }
}

TEST(FrontalDirect, FindsWhatChapter11Finds) {
  expect_what_chapter_11_finds<3>();
  expect_what_chapter_11_finds<6>();
}

/// The largest difference of two matrices of one pattern, over the largest entry.
double difference(const SparseMatrix& some, const SparseMatrix& others) {
  return (Eigen::MatrixXd(some) - Eigen::MatrixXd(others)).cwiseAbs().maxCoeff() /
         others.coeffs().cwiseAbs().maxCoeff();
}

TEST(RowSystem, IsSOfTheRows) {
  RowSystem kept;
  const double rounding = 12 * std::numeric_limits<double>::epsilon();  // twelve products at most
  Ladder<6> s(1, 9);
  for (unsigned seed = 1; seed <= 5; ++seed) {
    const Ladder<6> other(seed, 9);  // the same bodies, other numbers
    EXPECT_LE(difference(kept.matrix(other.rows), schur_complement(other.rows)), rounding) << "seed " << seed;
  }
  s.rows[7].Sigma = 3;
  EXPECT_LE(difference(kept.matrix(s.rows), schur_complement(s.rows)), rounding) << "another Σ";
  std::swap(s.rows[20].i, s.rows[20].j), std::swap(s.rows[20].Gi, s.rows[20].Gj);
  std::swap(s.rows[20].MinvGi, s.rows[20].MinvGj);
  EXPECT_LE(difference(kept.matrix(s.rows), schur_complement(s.rows)), rounding) << "bodies in the other order";
  s.rows[11].i = 1;
  EXPECT_LE(difference(kept.matrix(s.rows), schur_complement(s.rows)), rounding) << "another body";
  const int still = s.rows[12].j;
  for (Row<6>& row : s.rows) {
    if (row.i == still) row.MinvGi.setZero();
    if (row.j == still) row.MinvGj.setZero();
  }
  EXPECT_LE(difference(kept.matrix(s.rows), schur_complement(s.rows)), rounding) << "a body that became static";
  s.rows.pop_back();
  EXPECT_LE(difference(kept.matrix(s.rows), schur_complement(s.rows)), rounding) << "a row less";
}

/// There is no solution, and no change.
void expect_nothing(Ladder<3> s, const char* why) {
  const Ladder<3> before = s;
  FrontalFactors kept;
  EXPECT_FALSE(frontal_direct(s.rows, s.V, {}, kept)) << why;
  for (std::size_t k = 0; k < s.rows.size(); ++k) EXPECT_EQ(s.rows[k].lambda, before.rows[k].lambda) << why;
  EXPECT_EQ(s.V, before.V) << why;
}

TEST(FrontalDirect, ReturnsNothingForUnsuitableRows) {
  expect_nothing(Ladder<3>(1, 1), "no rows");
  expect_nothing(Ladder<3>(1, 20, 0), "no room");
  expect_nothing(Ladder<3>(1, 20, 1e-9), "bounds that are active");
  Ladder<3> twice(1, 20);
  twice.rows[30].Sigma = 0;
  twice.rows.push_back(twice.rows[30]);
  expect_nothing(twice, "an equal row, Σ = 0: a pivot of round-off");
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), infinity}) {
    Ladder<3> s(1, 20);
    s.rows[9].B = bad;
    expect_nothing(s, "a B that is not finite");
  }
}

TEST(FrontalDirect, RefusesWhatSolveRefuses) {
  Ladder<3> s(1, 4);
  FrontalFactors kept;
  expect_refusal({"max_sweeps", "0"}, [&] { frontal_direct(s.rows, s.V, {.max_sweeps = 0}, kept); });
  expect_refusal({"tolerance", "-1"}, [&] { frontal_direct(s.rows, s.V, {.tolerance = -1}, kept); });
}

}  // namespace
}  // namespace spook::frontal_direct_test
