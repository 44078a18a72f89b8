#pragma once
// Contacts of capsules. A capsule is the union of balls along a segment, so each of its contacts is that of a ball on
// the segment:
//
//   x(t)      centre + t half_length axis, for t from -1 to 1
//   g(t)      the gap of the ball at x(t). A signed distance from a convex shape is a convex function of t
//   plane     g is linear: the two ends, Eq. (8.1)
//   others    the t of the least gap; if the segment runs along a face, an edge or another segment, also the two ends
//             of the common part, if they touch. So a capsule that lies on a face stands on two contacts
//
// Not in the notes.
#include "08_pairs/pairs.hpp"
#include "engine/bodies/capsule.hpp"

namespace spook {

/// A capsule at its current position.
struct PlacedCapsule {
  int body;
  Vec3 x;              ///< centre [m]
  Vec3 axis;           ///< unit vector along its segment
  double radius;       ///< [m]
  double half_length;  ///< [m]

  /// Returns the ball at x(t).
  Ball ball(double t) const { return {.body = body, .x = x + t * half_length * axis, .radius = radius}; }
};

/// Returns a capsule at the position and orientation of its body.
PlacedCapsule place(const Capsule& capsule, int body, const Vec3& x, const Quat& q);

Bounds bounds(const PlacedCapsule& capsule);

/// Appends the contacts of a plane (body i) with a capsule (body j), one for each end that touches.
void add_contacts(const Plane& plane, const PlacedCapsule& capsule, std::vector<Contact>& contacts);

/// Appends the contact of a capsule (body i) with a ball (body j), if they touch.
void add_contacts(const PlacedCapsule& capsule, const Ball& ball, std::vector<Contact>& contacts);

/// Appends the contacts of two capsules, three at most.
void add_contacts(const PlacedCapsule& i, const PlacedCapsule& j, std::vector<Contact>& contacts);

/// Appends the contacts of a box (body i) with a capsule (body j), three at most.
void add_contacts(const Box& box, const PlacedCapsule& capsule, std::vector<Contact>& contacts);

}  // namespace spook
