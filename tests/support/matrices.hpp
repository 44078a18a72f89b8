#pragma once
// Units of sparse matrices for contract.hpp: matrices with one unit throughout, and saddle-point matrices.
#include "11_direct/direct.hpp"
#include "units.hpp"

namespace spook::testing {

/// The positions of the entries of a compressed matrix.
inline void count_entries(Visitor& visitor, const SparseMatrix& A) {
  visitor.count(A.rows()), visitor.count(A.cols()), visitor.count(A.nonZeros());
}

inline void each_number(Visitor& visitor, SparseMatrix& A, const Unit& unit) {
  count_entries(visitor, A);
  for (int column = 0; column < A.outerSize(); ++column)
    for (SparseMatrix::InnerIterator entry(A, column); entry; ++entry) {
      visitor.count(entry.row());
      visitor.number(entry.valueRef(), unit);
    }
}

/// The matrix of Eq. (11.2), for so many bodies with so many unknowns each, the first few of them static. M is in kg,
/// kg m and kg m², and 1 for a static body; G in 1 and m; Σ in 1/kg.
struct SaddleUnits {
  int bodies, dof, fixed;

  Unit of(Eigen::Index row, Eigen::Index column) const {
    const Unit both = size(row) * size(column);
    return {both.mass / 2, both.length, both.time};
  }

 private:
  /// The unit of an unknown: √kg, √kg m, 1/√kg. Here powers of the mass are doubled, so that they are whole.
  Unit size(Eigen::Index k) const {
    if (k >= bodies * dof) return {-1, 0, 0};
    if (k < fixed * dof) return {};
    return {1, k % dof < 3 ? 0 : 1, 0};
  }
};

inline void each_number(Visitor& visitor, SparseMatrix& A, const SaddleUnits& units) {
  count_entries(visitor, A);
  for (int column = 0; column < A.outerSize(); ++column)
    for (SparseMatrix::InnerIterator entry(A, column); entry; ++entry) {
      visitor.count(entry.row());
      visitor.number(entry.valueRef(), units.of(entry.row(), column));
    }
}

}  // namespace spook::testing
