#pragma once
// Shapes of bodies: a closed list. Code that depends on the shape visits the variant, so that a new shape is a compile
// error in each place that does not handle it yet.
#include <utility>
#include <variant>
#include <vector>

#include "common/types.hpp"

namespace spook {

/// The shape of a body without contacts.
struct NoShape {};

struct Sphere {
  double radius;  ///< [m]
};

/// All points within `radius` of a segment along the body's z axis, from -half_length to half_length.
struct Capsule {
  double radius;       ///< [m]
  double half_length;  ///< of the segment [m]
};

/// A box along the body's axes.
struct Cuboid {
  Vec3 half_sides;  ///< [m]
};

/// Points that touch planes only.
struct PointSet {
  std::vector<Vec3> points;  ///< from the centre, in the body's axes [m]
};

using Shape = std::variant<NoShape, Sphere, Capsule, Cuboid, PointSet>;

/// The handlers as one function with several overloads.
template <class... Handlers>
struct Handling : Handlers... {
  using Handlers::operator()...;
};
template <class... Handlers>
Handling(Handlers...) -> Handling<Handlers...>;
/// Calls the handler for the type that `shape` holds.
template <class Variant, class... Handlers>
decltype(auto) match(Variant&& shape, Handlers&&... handlers) {
  return std::visit(Handling{std::forward<Handlers>(handlers)...}, std::forward<Variant>(shape));
}

/// Throws std::invalid_argument, naming the radius, half length, half side or corner, unless radii and half sides are
/// positive and finite, a half length is finite and not negative, and points are finite.
void require_sound(const Shape& shape);

/// Returns the size of a shape [m], to which penetration is compared: a radius, the least half side, the distance of
/// the farthest point; infinity without a shape.
double size_of(const Shape& shape);

/// Returns the principal moments of a solid sphere, 2/5 m r² each [kg m²].
Vec3 solid_sphere_moments(double mass, double radius);

/// Returns the principal moments of a solid box, m/3 (b² + c²) and so on [kg m²], from the halves of its sides [m].
Vec3 solid_box_moments(double mass, const Vec3& half_sides);

/// Returns the principal moments of a solid capsule along z [kg m²], the sum of a cylinder of half length L and mass
/// m_c and of two half balls of total mass m_s, with masses in proportion to volume:
/// I_z = m_c r²/2 + m_s 2/5 r²,   I_x = I_y = m_c (r²/4 + L²/3) + m_s (2/5 r² + L² + 3/4 r L)
Vec3 solid_capsule_moments(double mass, double radius, double half_length);

/// Returns the eight corners of a box [m].
std::vector<Vec3> box_corners(const Vec3& half_sides);

}  // namespace spook
