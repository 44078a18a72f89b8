// Wrong: leaves out the entries of S that are 0.
// Killed by: BarrierMatrix.KeepsThePatternAndTheRest
// Says: An entry that is 0 is part of the pattern
#include "11_direct/direct.hpp"

namespace spook {

SparseMatrix barrier_matrix(const SparseMatrix& S, const Interior& now) {
  SparseMatrix barrier = S;
  // In a lower triangle the diagonal comes first in its column. A bound that is not there has z/s = 0/∞ = 0.
  for (int k = 0; k < S.cols(); ++k)
    barrier.coeffRef(k, k) += now.push_lo[k] / now.room_lo[k] + now.push_hi[k] / now.room_hi[k];  // Eq. (11.7)
  barrier.prune(0.0);
  return barrier;
}

}  // namespace spook
