#pragma once
// Spheres. What each member means is said in engine/bodies/shape.hpp.
//
//   entry   t = -b - √(R² - c²), with b = o·u from the centre, and c the distance of the centre from the line
#include <optional>
#include <tuple>

#include "engine/bodies/line_entry.hpp"

namespace spook {

struct Sphere {
  double radius;  ///< [m]

  void require_sound() const;
  double size() const { return radius; }
  double reach() const { return radius; }
  auto numbers() const { return std::tie(radius); }
  double volume() const;
  Vec3 moments(double mass) const;
  double signed_distance(const Vec3& x) const { return x.norm() - radius; }
  std::optional<LineEntry> entry(const Vec3& o, const Vec3& u) const;
  Vec3 visible_turn(const Vec3&) const { return Vec3::Zero(); }
};

/// Returns the principal moments of a solid sphere, 2/5 m r² each [kg m²].
Vec3 solid_sphere_moments(double mass, double radius);

}  // namespace spook
