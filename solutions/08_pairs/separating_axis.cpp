#include <algorithm>
#include <cmath>

#include "08_pairs/pairs.hpp"

namespace spook {

namespace {

/// ρ(n), half of what a box measures along n.
double half_width(const Box& box, const Vec3& n) {
  return box.half_sides.dot((box.axes.transpose() * n).cwiseAbs());
}

/// The best of one kind: where some are alike, to `margin`, the first of them.
struct Best {
  const Box &i, &j;
  double margin;
  SeparatingAxis axis = {.n = Vec3::Zero(), .gap = -infinity};

  /// `next` lacks its gap, and its sign.
  void consider(SeparatingAxis next) {
    const double along = next.n.dot(j.x - i.x);
    if (along < 0) next.n = -next.n;
    next.gap = std::abs(along) - half_width(i, next.n) - half_width(j, next.n);  // Eq. (8.6)
    const double ahead = next.gap > 0 ? 0 : margin;                              // whatever parts them will do
    if (next.gap > axis.gap + ahead) axis = next;
  }
};

}  // namespace

SeparatingAxis separating_axis(const Box& i, const Box& j) {
  const double margin = 1e-6 * std::min(i.half_sides.minCoeff(), j.half_sides.minCoeff());
  Best face_i{i, j, margin}, face_j{i, j, margin}, edges{i, j, 0};
  for (int k = 0; k < 3; ++k) face_i.consider({.n = i.axes.col(k), .gap = 0, .face_i = k});
  if (face_i.axis.gap > 0) return face_i.axis;  // what parts them is enough
  for (int k = 0; k < 3; ++k) face_j.consider({.n = j.axes.col(k), .gap = 0, .face_j = k});
  if (face_j.axis.gap > 0) return face_j.axis;
  for (int a = 0; a < 3; ++a)
    for (int b = 0; b < 3; ++b) {
      const Vec3 across = i.axes.col(a).cross(j.axes.col(b));
      const double sine = across.norm();
      if (sine > 1e-6) edges.consider({.n = across / sine, .gap = 0, .edge_i = a, .edge_j = b});
    }

  SeparatingAxis best = face_i.axis;  // Eq. (8.7)
  for (const SeparatingAxis& other : {face_j.axis, edges.axis})
    if (other.gap > 0 || other.gap > best.gap + 0.05 * std::abs(best.gap) + margin) best = other;
  return best;
}

}  // namespace spook
