#include <algorithm>
#include <cmath>

#include "08_pairs/pairs.hpp"

namespace spook {

namespace {

/// An axis and the gap along it: indices of the face or edges, -1 for unused ones.
struct Found {
  double gap = -infinity;
  int face_i = -1, face_j = -1, edge_i = -1, edge_j = -1;
};

/// The best axis of one kind: the first of axes whose gaps are equal within `margin`.
struct Best {
  double margin;
  Found axis = {};

  void consider(const Found& next) {
    const double ahead = next.gap > 0 ? 0 : margin;  // any separating axis suffices
    if (next.gap > axis.gap + ahead) axis = next;
  }
};

SeparatingAxis from_i_to_j(const Found& axis, const Box& i, const Box& j) {
  Vec3 n = Vec3::Zero();
  if (axis.face_i >= 0) n = i.axes.col(axis.face_i);
  if (axis.face_j >= 0) n = j.axes.col(axis.face_j);
  if (axis.edge_i >= 0) n = i.axes.col(axis.edge_i).cross(j.axes.col(axis.edge_j)).normalized();
  if (n.dot(j.x - i.x) < 0) n = -n;
  return {n, axis.gap, axis.face_i, axis.face_j, axis.edge_i, axis.edge_j};
}

}  // namespace

/// In the axes of i its own axes are (1, 0, 0), (0, 1, 0) and (0, 0, 1), and those of j the columns of C. So n·e_k are
/// numbers of C, and of all faces of a box (8.6) is one line.
SeparatingAxis separating_axis(const Box& i, const Box& j) {
  const double margin = 1e-3 * std::min(i.half_sides.minCoeff(), j.half_sides.minCoeff());
  const Vec3 &a = i.half_sides, &b = j.half_sides;
  const Mat3 C = i.axes.transpose() * j.axes, C_abs = C.cwiseAbs();
  const Vec3 apart = i.axes.transpose() * (j.x - i.x), apart_j = C.transpose() * apart;
  if (apart_j.hasNaN() || a.hasNaN() || b.hasNaN()) return from_i_to_j({}, i, j);

  Best face_i{margin}, face_j{margin}, edges{0};
  const Vec3 gap_i = apart.cwiseAbs() - a - C_abs * b;
  for (int k = 0; k < 3; ++k) face_i.consider({.gap = gap_i[k], .face_i = k});
  if (face_i.axis.gap > 0) return from_i_to_j(face_i.axis, i, j);  // what parts them is enough
  const Vec3 gap_j = apart_j.cwiseAbs() - C_abs.transpose() * a - b;
  for (int k = 0; k < 3; ++k) face_j.consider({.gap = gap_j[k], .face_j = k});
  if (face_j.axis.gap > 0) return from_i_to_j(face_j.axis, i, j);

  for (int e = 0; e < 3; ++e) {
    const int e1 = (e + 1) % 3, e2 = (e + 2) % 3;
    for (int f = 0; f < 3; ++f) {
      const int f1 = (f + 1) % 3, f2 = (f + 2) % 3;
      // e_e x f_f has the parts -C(e2, f) along e1 and C(e1, f) along e2; e_e·(f_f x f_f1) = C(e, f2).
      const double sine = std::sqrt(C(e1, f) * C(e1, f) + C(e2, f) * C(e2, f));
      const double along = std::abs(apart[e2] * C(e1, f) - apart[e1] * C(e2, f));
      const double half_i = a[e1] * C_abs(e2, f) + a[e2] * C_abs(e1, f);
      const double half_j = b[f1] * C_abs(e, f2) + b[f2] * C_abs(e, f1);
      if (sine > 1e-6) edges.consider({.gap = (along - half_i - half_j) / sine, .edge_i = e, .edge_j = f});
    }
  }

  Found best = face_i.axis;  // Eq. (8.7)
  for (const Found& other : {face_j.axis, edges.axis})
    if (other.gap > 0 || other.gap > best.gap + 0.05 * std::abs(best.gap) + margin) best = other;
  return from_i_to_j(best, i, j);
}

}  // namespace spook
