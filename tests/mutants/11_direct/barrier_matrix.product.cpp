// Wrong: adds push times room.
// Killed by: BarrierMatrix.StiffensTheDiagonal
// Says: Push over room
#include "11_direct/direct.hpp"

namespace spook {

SparseMatrix barrier_matrix(const SparseMatrix& S, const Interior& now) {
  SparseMatrix barrier = S;
  // In a lower triangle the diagonal comes first in its column. A bound that is not there has z/s = 0/∞ = 0.
  for (int k = 0; k < S.cols(); ++k)
    barrier.coeffRef(k, k) += (now.push_lo[k] > 0 ? now.push_lo[k] * now.room_lo[k] : 0) +
                              (now.push_hi[k] > 0 ? now.push_hi[k] * now.room_hi[k] : 0);  // Eq. (11.7)
  return barrier;
}

}  // namespace spook
