// Wrong: lets λ and its rooms drift apart.
// Killed by: InteriorStep.LetsTheSmallestOfThreeSetTheOthers
// Says: λ had drifted from its rooms
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

/// μ, over the bounds that there are; NaN when there are none.
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

}  // namespace

Interior interior_step(const SparseMatrix& S, const Vector& B, const Vector&, const Vector&,
                       const Interior& now, const Factors& factors) {
  const Vector none = Vector::Zero(B.size());
  const Interior straight = newton_step(S, B, now, {.lo = none, .hi = none}, factors);
  const double far = longest_step(now, straight);
  const double before = mean_product(now), after = mean_product(moved(now, straight, far));
  const Vector centre = Vector::Constant(B.size(), before > 0 ? std::pow(after / before, 3) * before : 0);
  const Target target{.lo = centre - far * straight.room_lo.cwiseProduct(straight.push_lo),  // Eq. (11.11)
                      .hi = centre - far * straight.room_hi.cwiseProduct(straight.push_hi)};

  const Interior step = newton_step(S, B, now, target, factors);
  const double longest = longest_step(now, step);
  Interior next = moved(now, step, longest < 1 ? 0.999 * longest : 1);  // rooms stay positive
  return next;
}

}  // namespace spook
