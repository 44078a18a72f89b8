#pragma once
// Factors of the matrix of Eq. (11.15), whose unknowns are velocities of bodies: dense factors for small systems, else
// sparse ones.
#include "engine/linear/dense_ldlt.hpp"
#include "engine/linear/frontal_cholesky.hpp"

namespace spook {

/// Dense or sparse factors of the last matrix.
class VelocityFactors {
 public:
  /// Factorises a symmetric positive definite matrix, given as its lower triangle, compressed, with all of its diagonal.
  /// Returns false, with useless factors,
  /// if a pivot fails Eq. (11.4).
  bool factorise(const SparseMatrix& A) {
    is_small_ = A.cols() <= DenseLdlt::most;
    if (!is_small_) return sparse_.factorise(A);
    small_.begin(static_cast<int>(A.cols()));
    for (int column = 0; column < A.outerSize(); ++column)
      for (SparseMatrix::InnerIterator entry(A, column); entry; ++entry)
        small_.at(static_cast<int>(entry.row()), column) = entry.value();
    return small_.factorise();
  }

  Vector solve(Vector right) const {
    if (!is_small_) return sparse_.solve(right);
    small_.solve(right.data());
    return right;
  }

  /// Returns the number of symbolic analyses so far. Small systems add none.
  int analyses() const { return sparse_.analyses(); }

 private:
  bool is_small_ = true;
  DenseLdlt small_;
  FrontalCholesky sparse_;
};

}  // namespace spook
