#include <algorithm>
#include <cmath>

#include "11_direct/direct.hpp"

namespace spook {

namespace {

Interior moved(const Interior& now, const Interior& step, double share) {
  return {.lambda = now.lambda + share * step.lambda,
          .room_lo = now.room_lo + share * step.room_lo,
          .room_hi = now.room_hi + share * step.room_hi,
          .push_lo = now.push_lo + share * step.push_lo,
          .push_hi = now.push_hi + share * step.push_hi};
}

/// Returns μ, the mean product over all bounds; NaN if there are none.
double mean_product(const Interior& now) {
  double sum = 0;
  int bounds = 0;
  const auto add = [&](const Vector& room, const Vector& push) {
    for (Eigen::Index k = 0; k < room.size(); ++k)
      if (std::isfinite(room[k])) sum += room[k] * push[k], ++bounds;
  };
  add(now.room_lo, now.push_lo);
  add(now.room_hi, now.push_hi);
  return sum / bounds;
}

/// Makes λ and its two slacks consistent again: each has the round-off of its former size, and the smallest is the most
/// exact.
void reconcile(const Vector& lo, const Vector& hi, Interior& now) {
  for (Eigen::Index k = 0; k < lo.size(); ++k) {
    double &lambda = now.lambda[k], &below = now.room_lo[k], &above = now.room_hi[k];
    const double smallest = std::min({std::abs(lambda), below, above});
    if (smallest == below) lambda = lo[k] + below;
    if (smallest == above) lambda = hi[k] - above;
    if (smallest != below) below = lambda - lo[k];
    if (smallest != above) above = hi[k] - lambda;
  }
}

}  // namespace

Interior interior_step(const SparseMatrix& S, const Vector& B, const Vector& lo, const Vector& hi,
                       const Interior& now, const Factors& factors) {
  const Vector none = Vector::Zero(B.size());
  const Interior straight = newton_step(S, B, now, {.lo = none, .hi = none}, factors);
  const double far = longest_step(now, straight);
  const double before = mean_product(now), after = mean_product(moved(now, straight, far));
  const Vector centre = Vector::Constant(B.size(), before > 0 ? std::pow(after / before, 3) * before : 0);
  const Target target{.lo = centre - straight.room_lo.cwiseProduct(straight.push_lo),  // Eq. (11.11)
                      .hi = centre - straight.room_hi.cwiseProduct(straight.push_hi)};

  const Interior step = newton_step(S, B, now, target, factors);
  const double longest = longest_step(now, step);
  Interior next = moved(now, step, longest < 1 ? (0.9 + 0.0999 * far) * longest : 1);
  reconcile(lo, hi, next);
  return next;
}

}  // namespace spook
