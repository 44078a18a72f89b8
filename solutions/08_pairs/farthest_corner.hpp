#pragma once
// The corner of a box that is farthest along a direction, for contacts of faces and of edges.
#include <cmath>

#include "08_pairs/pairs.hpp"

namespace spook {

/// Returns the corner with the largest n·(p - x), as p - x [m]. Of corners that are equal up to round-off, returns the one
/// that plane_box has first. So the contacts of a resting box are in the same order in every step.
inline Vec3 farthest_corner(const Box& box, const Vec3& n) {
  Vec3 corner = box.half_sides;
  for (int k = 0; k < 3; ++k) corner[k] = std::copysign(corner[k], n.dot(box.axes.col(k)) - 1e-12);
  return box.axes * corner;
}

}  // namespace spook
