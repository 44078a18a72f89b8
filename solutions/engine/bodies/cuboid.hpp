#pragma once
// Boxes. What each member means is said in engine/bodies/shape.hpp.
//
//   entry   the last t at which the line enters a slab |x_k| < h_k, if it leaves no slab before
#include <optional>
#include <tuple>
#include <vector>

#include "engine/bodies/line_entry.hpp"

namespace spook {

/// A box along the body's axes.
struct Cuboid {
  Vec3 half_sides;  ///< [m]

  void require_sound() const;
  double size() const { return half_sides.minCoeff(); }
  double reach() const { return half_sides.norm(); }
  auto numbers() const { return std::tie(half_sides); }
  double volume() const { return 8 * half_sides.prod(); }
  Vec3 moments(double mass) const;
  double signed_distance(const Vec3& x) const;
  std::optional<LineEntry> entry(const Vec3& o, const Vec3& u) const;
  Vec3 visible_turn(const Vec3& turn) const { return turn; }
};

/// Returns the principal moments of a solid box, m/3 (b² + c²) and so on [kg m²], from the halves of its sides [m].
Vec3 solid_box_moments(double mass, const Vec3& half_sides);

/// Returns the eight corners of a box [m].
std::vector<Vec3> box_corners(const Vec3& half_sides);

}  // namespace spook
