#pragma once
// Capsules. What each member means is said in engine/bodies/shape.hpp.
//
//   entry   into an endless cylinder: that of a sphere, with b and c measured across the segment. If it is beyond the
//           end of the segment, the sphere at that end decides
#include <optional>
#include <tuple>

#include "engine/bodies/line_entry.hpp"

namespace spook {

/// All points within `radius` of a segment along the body's z axis, from -half_length to half_length.
struct Capsule {
  double radius;       ///< [m]
  double half_length;  ///< of the segment [m]

  void require_sound() const;
  double size() const { return radius; }
  double reach() const { return radius + half_length; }
  auto numbers() const { return std::tie(radius, half_length); }
  double volume() const;
  Vec3 moments(double mass) const;
  double signed_distance(const Vec3& x) const;
  std::optional<LineEntry> entry(const Vec3& o, const Vec3& u) const;
  Vec3 visible_turn(const Vec3& turn) const { return {turn.x(), turn.y(), 0}; }
};

/// Returns the principal moments of a solid capsule along z [kg m²], the sum of a cylinder of half length L and mass
/// m_c and of two half balls of total mass m_s, with masses in proportion to volume:
/// I_z = m_c r²/2 + m_s 2/5 r²,   I_x = I_y = m_c (r²/4 + L²/3) + m_s (2/5 r² + L² + 3/4 r L)
Vec3 solid_capsule_moments(double mass, double radius, double half_length);

}  // namespace spook
