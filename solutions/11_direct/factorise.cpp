#include <algorithm>
#include <cmath>

#include "11_direct/direct.hpp"

namespace spook {

static bool same_pattern(const SparseMatrix& A, const Factors& factors) {
  return std::ssize(factors.columns) == A.outerSize() + 1 && std::ssize(factors.entries) == A.nonZeros() &&
         std::equal(factors.columns.begin(), factors.columns.end(), A.outerIndexPtr()) &&
         std::equal(factors.entries.begin(), factors.entries.end(), A.innerIndexPtr());
}

/// Returns for each pivot the sum of absolute values from which it is computed: |A_kk| + Σ_j L_kj² |D_j|.
static Vector pivot_terms(const SparseMatrix& A, const Factors& factors, const Vector& D) {
  Vector sum = (factors.ldlt.permutationP() * Vector(A.diagonal())).cwiseAbs();
  const SparseMatrix& L = factors.ldlt.matrixL().nestedExpression();  // without its diagonal of ones
  for (int j = 0; j < L.cols(); ++j)
    for (SparseMatrix::InnerIterator entry(L, j); entry; ++entry)
      sum[entry.row()] += entry.value() * entry.value() * std::abs(D[j]);
  return sum;
}

bool factorise(const SparseMatrix& A, Factors& factors) {
  if (!same_pattern(A, factors)) {
    factors.ldlt.analyzePattern(A);
    factors.columns.assign(A.outerIndexPtr(), A.outerIndexPtr() + A.outerSize() + 1);
    factors.entries.assign(A.innerIndexPtr(), A.innerIndexPtr() + A.nonZeros());
    ++factors.analyses;
  }
  factors.ldlt.factorize(A);
  if (factors.ldlt.info() != Eigen::Success) return false;

  const Vector D = factors.ldlt.vectorD(), terms = pivot_terms(A, factors, D);
  const auto is_sound = [](double pivot, double sum) {  // Eq. (11.4)
    return std::isfinite(pivot) && std::abs(pivot) > 1e-14 * sum;
  };
  return std::equal(D.begin(), D.end(), terms.begin(), is_sound);
}

}  // namespace spook
