#pragma once
// Factors of Eq. (11.15), whose unknowns are velocities of bodies: dense ones of few, else chapter 11's.
#include "11_direct/direct.hpp"
#include "engine/linear/dense_ldlt.hpp"

namespace spook {

/// Either kind, whichever the last matrix had.
class VelocityFactors {
 public:
  /// Takes a symmetric positive definite matrix, given as its lower triangle. False for a pivot that is not sound, Eq. (11.4);
  /// the factors are then of no use.
  bool factorise(const SparseMatrix& A) {
    is_small_ = A.cols() <= DenseLdlt::most;
    if (!is_small_) return spook::factorise(A, sparse_);
    small_.begin(static_cast<int>(A.cols()));
    for (int column = 0; column < A.outerSize(); ++column)
      for (SparseMatrix::InnerIterator entry(A, column); entry; ++entry)
        small_.at(static_cast<int>(entry.row()), column) = entry.value();
    return small_.factorise();
  }

  Vector solve(Vector right) const {
    if (!is_small_) return sparse_.ldlt.solve(right);
    small_.solve(right.data());
    return right;
  }

  /// Returns the number of symbolic analyses. Always 0 for small systems.
  int analyses() const { return sparse_.analyses; }

 private:
  bool is_small_ = true;
  DenseLdlt small_;
  Factors sparse_;
};

}  // namespace spook
