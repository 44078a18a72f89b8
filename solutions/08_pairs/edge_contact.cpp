#include "08_pairs/farthest_corner.hpp"
#include "08_pairs/pairs.hpp"

namespace spook {

Contact edge_contact(const Box& i, const Box& j, const SeparatingAxis& axis) {
  const Vec3 a = i.axes.col(axis.edge_i), b = j.axes.col(axis.edge_j), apart = j.x - i.x;
  // These corners are ends of the edges, so a line through them is a line through the edges.
  const Vec3 on_i = farthest_corner(i, axis.n), on_j = apart + farthest_corner(j, -axis.n);
  const Vec3 across = a.cross(b), between = on_j - on_i;
  const double s = between.cross(b).dot(across) / across.squaredNorm();  // Eq. (8.9)
  const double t = between.cross(a).dot(across) / across.squaredNorm();
  const Vec3 r = (on_i + s * a + on_j + t * b) / 2;
  return {.i = i.body, .j = j.body, .n = axis.n, .gap = axis.gap, .r_i = r, .r_j = r - apart};
}

}  // namespace spook
