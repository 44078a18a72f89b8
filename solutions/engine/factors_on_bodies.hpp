#pragma once
// Factors of Eq. (11.15), whose unknowns are velocities of bodies: dense ones of few, else chapter 11's.
#include "11_direct/direct.hpp"
#include "engine/small_factors.hpp"

namespace spook {

/// Either kind, whichever the last matrix had.
class FactorsOnBodies {
 public:
  /// Takes a symmetric positive definite matrix, given as its lower triangle. False for a pivot that is not sound, Eq. (11.4);
  /// the factors are then of no use.
  bool factorise(const SparseMatrix& A) {
    few_ = A.cols() <= SmallFactors::most;
    if (!few_) return spook::factorise(A, many_of_);
    few_of_.begin(static_cast<int>(A.cols()));
    for (int column = 0; column < A.outerSize(); ++column)
      for (SparseMatrix::InnerIterator entry(A, column); entry; ++entry)
        few_of_.at(static_cast<int>(entry.row()), column) = entry.value();
    return few_of_.factorise();
  }

  Vector solve(Vector right) const {
    if (!few_) return many_of_.ldlt.solve(right);
    few_of_.solve(right.data());
    return right;
  }

  /// How often an order and a pattern were looked for: never, of few.
  int analyses() const { return many_of_.analyses; }

 private:
  bool few_ = true;
  SmallFactors few_of_;
  Factors many_of_;
};

}  // namespace spook
