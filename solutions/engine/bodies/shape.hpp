#pragma once
// Shapes of bodies: a closed list of types with the same members. Code calls these members, or visits the variant, so
// that a new shape is a compile error in each place that does not handle it yet. In the body's axes:
//
//   require_sound()      throws std::invalid_argument, naming the number, unless radii and half sides are positive and
//                        finite, a half length is finite and not negative, and points are finite
//   size()               the length to which penetration is compared [m]: a radius, the least half side, the distance
//                        of the farthest point; infinity without a shape
//   reach()              the radius of a ball around the centre that contains the shape [m]; 0 without a shape
//   numbers()            all numbers that define the shape, as a tuple
//
// A shape with an interior also has
//
//   volume()             [m³]
//   moments(mass)        the principal moments of a solid body [kg m²]
//   signed_distance(x)   the distance of a point from the surface [m], negative inside
//   entry(o, u)          where the line o + t u enters the interior, if it does; u has unit length
//   visible_turn(turn)   the part of a rotation vector that moves the surface: none of a sphere's
#include <concepts>
#include <optional>
#include <tuple>
#include <utility>
#include <variant>

#include "04_gauss_seidel/gauss_seidel.hpp"
#include "engine/bodies/capsule.hpp"
#include "engine/bodies/cuboid.hpp"
#include "engine/bodies/point_set.hpp"
#include "engine/bodies/sphere.hpp"

namespace spook {

/// The shape of a body without contacts.
struct NoShape {
  void require_sound() const {}
  double size() const { return infinity; }
  double reach() const { return 0; }
  auto numbers() const { return std::tuple(); }
};

using Shape = std::variant<NoShape, Sphere, Capsule, Cuboid, PointSet>;

template <class Type>
concept HasInterior = requires(const Type& shape, double mass, const Vec3& vector) {
  { shape.volume() } -> std::same_as<double>;
  { shape.moments(mass) } -> std::same_as<Vec3>;
  { shape.signed_distance(vector) } -> std::same_as<double>;
  { shape.entry(vector, vector) } -> std::same_as<std::optional<LineEntry>>;
  { shape.visible_turn(vector) } -> std::same_as<Vec3>;
};

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

/// Throws unless the numbers of the shape are valid, see above.
inline void require_sound(const Shape& shape) {
  match(shape, [](const auto& held) { held.require_sound(); });
}

/// Returns the member size() of the shape that a variant holds [m].
template <class Variant>
double size_of(const Variant& shape) {
  return match(shape, [](const auto& held) { return held.size(); });
}

/// Returns the member reach() of the shape that a variant holds [m].
template <class Variant>
double reach_of(const Variant& shape) {
  return match(shape, [](const auto& held) { return held.reach(); });
}

}  // namespace spook
