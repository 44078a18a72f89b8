#pragma once
// Queries: the first body on a ray, and the bodies within a distance of a point, at their current positions.
//
//   ray       x(t) = o + t u, u = direction/|direction|, for t from 0 to the length of the ray
//   hit       the least t at which the ray passes from the outside of a shape into its interior. So a ray that only
//             touches a surface does not hit it, and a body that contains the origin is not hit
//   plane     t = (offset - n·o)/(n·u), if n·u < 0
//   solids    the t of entry(o, u), which the header of each shape derives
//   points    have no interior, and are not found
//
// Results are exact to round-off. A query compares all shapes, each with its exact surface, so its time is proportional
// to their number. Not in the notes.
#include <optional>
#include <vector>

#include "engine/collision/contacts.hpp"

namespace spook {

struct RayHit {
  int body;
  Vec3 point;       ///< where the ray enters the body [m]
  Vec3 normal;      ///< of the surface there, outwards, of unit length
  double distance;  ///< of the point from the origin [m]
};

/// Returns the first body that a ray enters within `longest` [m], which may be infinite; at equal distances that with
/// the lowest index. The direction may have any length above 0. Throws std::invalid_argument, naming the parameter and
/// its value, unless the origin is finite, the direction finite and not zero, and `longest` zero or positive.
template <int Dof>
std::optional<RayHit> cast_ray(const Shapes& shapes, const Bodies<Dof>& bodies, const Vec3& origin,
                               const Vec3& direction, double longest);

/// Returns the bodies with a point within `radius` [m] of `centre`, in the order of their indices. With a radius of 0
/// these are the bodies that contain the point. Throws std::invalid_argument, naming the parameter and its value,
/// unless the centre is finite, and the radius finite and not negative.
template <int Dof>
std::vector<int> overlapping(const Shapes& shapes, const Bodies<Dof>& bodies, const Vec3& centre,
                             double radius);

/// The same for a World<3> or World<6>.
template <class AnyWorld>
std::optional<RayHit> cast_ray(const AnyWorld& world, const Vec3& origin, const Vec3& direction,
                               double longest = infinity) {
  return cast_ray(world.shapes(), world.bodies(), origin, direction, longest);
}
template <class AnyWorld>
std::vector<int> overlapping(const AnyWorld& world, const Vec3& centre, double radius) {
  return overlapping(world.shapes(), world.bodies(), centre, radius);
}

}  // namespace spook
