#pragma once
// Solids at their positions, and the contacts of two of them. With a margin, slightly open contacts are found, too:
// planes rise by the margin, round shapes grow, and the contacts of grown boxes are moved back to the boxes.
#include <variant>
#include <vector>

#include "08_pairs/pairs.hpp"
#include "engine/bodies/shape.hpp"
#include "engine/collision/capsules.hpp"

namespace spook {

/// One of several shapes, each with all members that engine/bodies/shape.hpp lists.
template <HasInterior... Shapes>
using SolidShape = std::variant<Shapes...>;

/// A shape that touches planes and all other solids, centred on a body.
struct Solid {
  int body;
  SolidShape<Sphere, Capsule, Cuboid> shape;
  bool is_static;  ///< two static solids have no contact
};

/// A solid at a position.
using PlacedSolid = std::variant<Ball, PlacedCapsule, Box>;

/// Returns a solid at position `x` [m] with orientation `q`.
PlacedSolid placed(const Solid& solid, const Vec3& x, const Quat& q);

/// Returns the bounds of a solid, enlarged by `more` [m] on each side.
Bounds bounds_of(const PlacedSolid& solid, double more);

/// Appends the contacts of a plane and a solid with a gap of at most `margin` [m].
void add_contacts_within(double margin, Plane plane, const PlacedSolid& solid, std::vector<Contact>& contacts);

/// Appends the contacts of two solids with a gap of at most `margin` [m].
void add_contacts_within(double margin, const PlacedSolid& one, const PlacedSolid& other,
                         std::vector<Contact>& contacts);

}  // namespace spook
