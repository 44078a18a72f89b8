// Sparse factors in dense fronts: the solution of dense factors for patterns of every kind, and a refusal of pivots
// that are not sound.
#include "engine/linear/frontal_cholesky.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <string>

#include "algebra.hpp"
#include "random_input.hpp"

namespace spook::frontal_cholesky_test {
namespace {

using Matrix = Eigen::MatrixXd;

/// The pairs of nodes that share entries.
using Pairs = std::vector<std::pair<int, int>>;

Pairs chain(int nodes) {
  Pairs pairs;
  for (int k = 1; k < nodes; ++k) pairs.emplace_back(k - 1, k);
  return pairs;
}

Pairs ring(int nodes) {
  Pairs pairs = chain(nodes);
  if (nodes > 2) pairs.emplace_back(0, nodes - 1);
  return pairs;
}

Pairs hub(int nodes) {
  Pairs pairs;
  for (int k = 1; k < nodes; ++k) pairs.emplace_back(0, k);
  return pairs;
}

Pairs net(int side) {
  Pairs pairs;
  for (int i = 0; i < side; ++i)
    for (int j = 0; j < side; ++j) {
      if (j + 1 < side) pairs.emplace_back(side * i + j, side * i + j + 1);
      if (i + 1 < side) pairs.emplace_back(side * i + j, side * (i + 1) + j);
    }
  return pairs;
}

Pairs at_random(int nodes, testing::Random& random) {
  Pairs pairs;
  for (int n = 0; n < 2 * nodes; ++n) {
    const int i = random.integer(0, nodes - 1), j = random.integer(0, nodes - 1);
    if (i != j) pairs.push_back(std::minmax(i, j));
  }
  return pairs;
}

/// A matrix with blocks of so many unknowns on the diagonal and for each pair. Its diagonal is dominant.
Matrix random_matrix(const std::vector<int>& unknowns, const Pairs& pairs, testing::Random& random) {
  std::vector<int> start{0};
  for (const int size : unknowns) start.push_back(start.back() + size);
  Matrix A = Matrix::Zero(start.back(), start.back());
  const auto fill = [&](int i, int j) {
    for (int k = start[i]; k < start[i + 1]; ++k)
      for (int l = start[j]; l < start[j + 1]; ++l) {
        const double entry = random.uniform(-1, 1);
        if (k != l) A(k, l) = A(l, k) = entry;
      }
  };
  for (int n = 0; n < std::ssize(unknowns); ++n) fill(n, n);
  for (const auto& [i, j] : pairs) fill(j, i);
  for (int k = 0; k < A.rows(); ++k) A(k, k) = A.row(k).cwiseAbs().sum() + random.uniform(0.1, 1);
  return A;
}

/// The lower triangle.
SparseMatrix lower(const Matrix& A) {
  return Matrix(A.triangularView<Eigen::Lower>()).sparseView();
}

Vector random_vector(Eigen::Index n, testing::Random& random) {
  Vector x(n);
  for (double& entry : x) entry = random.uniform(-1, 1);
  return x;
}

void expect_solution(FrontalCholesky& factors, const Matrix& A, const std::string& what,
                     testing::Random& random) {
  const Vector b = random_vector(A.rows(), random);
  ASSERT_TRUE(factors.factorise(lower(A))) << what;
  const Vector x = factors.solve(b);
  // A dominant diagonal: there is no growth, so each of at most n products and sums has an error of ε of their size.
  const double rounding = 4 * static_cast<double>(A.rows()) * std::numeric_limits<double>::epsilon();
  EXPECT_LE((A * x - b).norm(), rounding * A.norm() * x.norm()) << what;
  EXPECT_LE((x - testing::solution_of(A, b)).norm(),
            rounding * A.norm() * testing::norm_of_inverse(A) * x.norm())
      << what;
}

TEST(FrontalCholesky, SolvesMatricesOfEveryPattern) {
  testing::Random random;
  FrontalCholesky factors;  // one for all: it keeps nothing of its last matrix
  for (const int size : {1, 2, 3, 5, 6})
    for (const int nodes : {1, 2, 3, 7, 25}) {
      const std::string what = std::to_string(nodes) + " nodes of " + std::to_string(size);
      const std::vector<int> unknowns(nodes, size);
      expect_solution(factors, random_matrix(unknowns, {}, random), what + ", apart", random);
      expect_solution(factors, random_matrix(unknowns, chain(nodes), random), what + ", chain", random);
      expect_solution(factors, random_matrix(unknowns, ring(nodes), random), what + ", ring", random);
      expect_solution(factors, random_matrix(unknowns, hub(nodes), random), what + ", hub", random);
      expect_solution(factors, random_matrix(unknowns, at_random(nodes, random), random), what + ", random",
                      random);
    }
  expect_solution(factors, random_matrix(std::vector<int>(100, 3), net(10), random), "net", random);
}

TEST(FrontalCholesky, SolvesNodesOfDifferentSizes) {
  testing::Random random;
  FrontalCholesky factors;
  for (int n = 0; n < 40; ++n) {
    std::vector<int> unknowns;
    for (int k = 0; k < 30; ++k) unknowns.push_back(random.integer(1, 6));
    expect_solution(factors, random_matrix(unknowns, at_random(30, random), random), std::to_string(n), random);
  }
}

TEST(FrontalCholesky, AnalysesAPatternOnce) {
  testing::Random random;
  FrontalCholesky factors;
  const std::vector<int> unknowns(20, 3);
  for (int n = 0; n < 3; ++n)
    expect_solution(factors, random_matrix(unknowns, ring(20), random), "ring", random);
  EXPECT_EQ(factors.analyses(), 1);
  expect_solution(factors, random_matrix(unknowns, hub(20), random), "hub", random);
  expect_solution(factors, random_matrix(unknowns, ring(20), random), "ring again", random);
  EXPECT_EQ(factors.analyses(), 3);
}

TEST(FrontalCholesky, RefusesAPivotThatIsNotSound) {
  FrontalCholesky factors;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto factorised = [&](double a, double b, double c) {  // [a b; b c]
    return factors.factorise(lower((Matrix(2, 2) << a, b, b, c).finished()));
  };
  EXPECT_TRUE(factorised(4, 2, 1 + 1e-12)) << "a hundred times the bound of Eq. (11.4)";
  EXPECT_FALSE(factorised(4, 2, 1)) << "singular";
  EXPECT_FALSE(factorised(4, 2, 1 + 1e-15)) << "a pivot of round-off";
  EXPECT_FALSE(factorised(4, 2, 0.5)) << "a saddle";
  EXPECT_FALSE(factorised(-1, 1, 3));
  EXPECT_FALSE(factorised(nan, 1, 1));
  EXPECT_FALSE(factorised(1, nan, 1));
  EXPECT_FALSE(factorised(2, 1, std::numeric_limits<double>::infinity()));
  EXPECT_TRUE(factorised(4, 2, 2)) << "after refusals";
}

TEST(FrontalCholesky, FindsASingularPartOfALargeMatrix) {
  testing::Random random;
  FrontalCholesky factors;
  for (int last = 2; last < 60; last += 7) {
    Matrix A = random_matrix(std::vector<int>(20, 3), net(4), random);
    A.row(last) = A.row(last - 1), A.col(last) = A.col(last - 1);  // the same row twice
    A(last, last) = A(last - 1, last - 1);
    A(last, last - 1) = A(last - 1, last) = A(last, last);
    EXPECT_FALSE(factors.factorise(lower(A))) << last;
  }
}

}  // namespace
}  // namespace spook::frontal_cholesky_test
