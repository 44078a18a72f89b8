// Dense factors of few unknowns: the same as sparse ones, and a refusal of pivots that are not sound.
#include "engine/linear/dense_ldlt.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "algebra.hpp"
#include "engine/linear/velocity_factors.hpp"
#include "random_input.hpp"

namespace spook::dense_ldlt_test {
namespace {

using Matrix = Eigen::MatrixXd;

/// Positive definite, n x n; a part of its entries below the diagonal is 0.
Matrix random_matrix(int n, double zeros, testing::Random& random) {
  Matrix A = Matrix::Zero(n, n);
  for (int k = 0; k < n; ++k)
    for (int l = 0; l < k; ++l) {
      const bool zero = random.uniform(0, 1) < zeros;
      const double entry = random.uniform(-1, 1);
      if (!zero) A(k, l) = A(l, k) = entry;
    }
  for (int k = 0; k < n; ++k) A(k, k) = A.row(k).cwiseAbs().sum() + random.uniform(0.1, 1);  // dominant
  return A;
}

Vector random_vector(int n, testing::Random& random) {
  Vector x(n);
  for (double& entry : x) entry = random.uniform(-1, 1);
  return x;
}

void fill(const Matrix& A, DenseLdlt& factors) {
  factors.begin(static_cast<int>(A.rows()));
  for (int k = 0; k < A.rows(); ++k)
    for (int l = 0; l <= k; ++l) factors.at(k, l) = A(k, l);
}

TEST(DenseLdlt, SolveWhatTheyAreFactorsOf) {
  testing::Random random;
  DenseLdlt factors;  // one for all: it keeps nothing of its last matrix
  for (const double zeros : {0.0, 0.5, 0.9})
    for (int n = 1; n <= DenseLdlt::most; ++n) {
      const Matrix A = random_matrix(n, zeros, random);
      const Vector b = random_vector(n, random);
      fill(A, factors);
      ASSERT_TRUE(factors.factorise()) << n;
      Vector x = b;
      factors.solve(x.data());
      // A dominant diagonal: there is no growth, so the n products and sums of a line each have an error of ε of their
      // size.
      const double rounding = 4 * n * std::numeric_limits<double>::epsilon();
      EXPECT_LE((A * x - b).norm(), rounding * A.norm() * x.norm()) << n << " lines, zeros " << zeros;
      EXPECT_LE((x - testing::solution_of(A, b)).norm(),
                rounding * A.norm() * testing::norm_of_inverse(A) * x.norm())
          << n;
    }
}

TEST(DenseLdlt, RefuseAPivotThatIsNotSound) {
  DenseLdlt factors;
  const auto factorised = [&](double a, double b, double c) {  // [a b; b c]
    factors.begin(2);
    factors.at(0, 0) = a, factors.at(1, 0) = b, factors.at(1, 1) = c;
    return factors.factorise();
  };
  EXPECT_TRUE(factorised(4, 2, 1 + 1e-12)) << "a hundred times the bound of Eq. (11.4)";
  EXPECT_FALSE(factorised(4, 2, 1)) << "singular";
  EXPECT_FALSE(factorised(4, 2, 1 + 1e-15)) << "a pivot of round-off";
  EXPECT_FALSE(factorised(4, 2, 0.5)) << "a saddle";
  EXPECT_FALSE(factorised(0, 0, 1));
  EXPECT_FALSE(factorised(-1, 0, 1));
  EXPECT_FALSE(factorised(std::numeric_limits<double>::quiet_NaN(), 0, 1));
  EXPECT_FALSE(factorised(1, std::numeric_limits<double>::quiet_NaN(), 1));
  EXPECT_FALSE(factorised(1, 0, std::numeric_limits<double>::infinity()));
}

/// The lower triangle.
SparseMatrix lower(const Matrix& A) {
  return Matrix(A.triangularView<Eigen::Lower>()).sparseView();
}

TEST(VelocityFactors, AreDenseForFewVelocities) {
  testing::Random random;
  VelocityFactors factors;
  int analyses = 0;
  for (const int n : {DenseLdlt::most, DenseLdlt::most + 1, 6, 48}) {
    const Matrix A = random_matrix(n, 0.5, random);
    const Vector b = random_vector(n, random);
    ASSERT_TRUE(factors.factorise(lower(A)));
    if (n > DenseLdlt::most) ++analyses;
    EXPECT_EQ(factors.analyses(), analyses) << n << ": few have no pattern";
    const double rounding = 4 * n * std::numeric_limits<double>::epsilon();  // as above
    EXPECT_LE((A * factors.solve(b) - b).norm(), rounding * A.norm() * testing::norm_of_inverse(A) * b.norm())
        << n;
  }
}

TEST(VelocityFactors, RefuseWhatIsSingular) {
  VelocityFactors factors;
  for (const int n : {6, 60}) {
    Matrix A = Matrix::Identity(n, n);
    A.bottomRightCorner(2, 2).setOnes();
    EXPECT_FALSE(factors.factorise(lower(A))) << n;
  }
}

}  // namespace
}  // namespace spook::dense_ldlt_test
