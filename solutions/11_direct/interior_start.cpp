#include <algorithm>
#include <cmath>

#include "11_direct/direct.hpp"

namespace spook {

Interior interior_start(const SparseMatrix& S, const Vector& B, const Vector& lo, const Vector& hi,
                        const Vector& guess) {
  const auto n = B.size();
  const Vector S_kk = S.diagonal();
  double energy = 0;
  for (Eigen::Index k = 0; k < n; ++k) {
    const double least = std::clamp(0.0, lo[k], hi[k]), likely = std::clamp(guess[k], lo[k], hi[k]);
    energy = std::max(energy, B[k] * B[k] / S_kk[k] + S_kk[k] * (least * least + likely * likely));
  }
  if (energy == 0) energy = 1;

  Interior start;
  for (Vector* each : {&start.lambda, &start.room_lo, &start.room_hi, &start.push_lo, &start.push_hi})
    each->resize(n);
  for (Eigen::Index k = 0; k < n; ++k) {  // Eq. (11.12)
    const double room = std::min(std::sqrt(energy / S_kk[k]), (hi[k] - lo[k]) / 2);
    start.lambda[k] = std::max(lo[k] + room, std::min(0.0, hi[k] - room));
    start.room_lo[k] = start.lambda[k] - lo[k];
    start.room_hi[k] = hi[k] - start.lambda[k];
    start.push_lo[k] = energy / start.room_lo[k];
    start.push_hi[k] = energy / start.room_hi[k];
  }
  return start;
}

}  // namespace spook
