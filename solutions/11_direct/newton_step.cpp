#include <cmath>

#include "11_direct/direct.hpp"

namespace spook {

Interior newton_step(const SparseMatrix& S, const Vector& B, const Interior& now, const Target& target,
                     const Factors& factors) {
  const auto n = B.size();
  Interior step;
  // An infinite room makes τ/s zero.
  const Vector right = B - S.selfadjointView<Eigen::Lower>() * now.lambda +
                       target.lo.cwiseQuotient(now.room_lo) - target.hi.cwiseQuotient(now.room_hi);
  step.lambda = factors.ldlt.solve(right);  // Eq. (11.8)

  step.room_lo = step.room_hi = step.push_lo = step.push_hi = Vector::Zero(n);
  for (Eigen::Index k = 0; k < n; ++k) {  // Eq. (11.9)
    const double change = step.lambda[k];
    if (std::isfinite(now.room_lo[k])) {
      step.room_lo[k] = change;
      step.push_lo[k] = (target.lo[k] - now.push_lo[k] * change) / now.room_lo[k] - now.push_lo[k];
    }
    if (std::isfinite(now.room_hi[k])) {
      step.room_hi[k] = -change;
      step.push_hi[k] = (target.hi[k] + now.push_hi[k] * change) / now.room_hi[k] - now.push_hi[k];
    }
  }
  return step;
}

}  // namespace spook
