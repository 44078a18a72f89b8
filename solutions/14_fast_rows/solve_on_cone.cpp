#include <cmath>
#include <limits>

#include "14_fast_rows/fast_rows.hpp"

namespace spook {

namespace {

/// The sliding impulse as a function of α, Eq. (14.6).
struct Sliding {
  Vec2 s;             // S_tn over S_nn
  Eigen::Matrix2d A;  // S_tt after λ_n is eliminated
  Vec2 c;
  double free;  // λ_n without friction

  Sliding(const Mat3& S, const Vec3& q)
      : s(S.block<2, 1>(1, 0) / S(0, 0)),
        A(S.block<2, 2>(1, 1) - S(0, 0) * s * s.transpose()),
        c(q.tail<2>() - q[0] * s),
        free(q[0] / S(0, 0)) {}

  /// Returns (A + α)⁻¹ b.
  Vec2 solve(double alpha, const Vec2& b) const {
    const double a11 = A(0, 0) + alpha, a22 = A(1, 1) + alpha, a12 = A(0, 1);
    return Vec2(a22 * b[0] - a12 * b[1], a11 * b[1] - a12 * b[0]) / (a11 * a22 - a12 * a12);
  }
};

}  // namespace

Vec3 solve_on_cone(const Mat3& S, const Vec3& q, double mu) {
  if (q[0] <= 0) return 0 * q;  // Eq. (14.3); a NaN stays one
  const Sliding slide(S, q);
  if (mu == 0) return {slide.free, 0 * q[1], 0 * q[2]};

  // Newton's method on μ λ_n/|λ_t| - 1, which is nearly a line in α, and halving where it would leave low < α < high.
  double alpha = 0, low = 0, high = slide.c.norm() * (1 + mu * slide.s.norm()) / (mu * slide.free);
  Vec2 along;
  double press = 0;
  for (int n = 0; n < 100; ++n) {
    along = slide.solve(alpha, slide.c);
    press = slide.free - slide.s.dot(along);
    const double length = along.norm(), f = mu * press / length - 1;
    if (alpha == 0 && !(length > mu * press)) return {press, along[0], along[1]};  // Eq. (14.4)
    if (std::abs(f) <= 4 * std::numeric_limits<double>::epsilon()) break;
    (f < 0 ? low : high) = alpha;
    const Vec2 change = slide.solve(alpha, -along);
    const double slope =
        -mu * slide.s.dot(change) / length - mu * press * along.dot(change) / (length * length * length);
    const double newton = alpha - f / slope, next = low < newton && newton < high ? newton : (low + high) / 2;
    if (next == alpha) break;
    alpha = next;
  }
  return {press, along[0], along[1]};
}

}  // namespace spook
