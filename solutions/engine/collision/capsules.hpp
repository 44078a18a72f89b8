#pragma once
// Contacts of capsules. A capsule is a ball that has moved along a segment, so that each of its contacts is one of a
// ball somewhere on it:
//
//   x(t)      centre + t half_length axis, for t from -1 to 1
//   g(t)      the gap of the ball at x(t). A signed distance from a convex shape is a convex function of t
//   plane     g is linear: the two ends, Eq. (8.1)
//   others    the lowest point; and where the segment runs along a face, an edge or another segment, the two ends of that
//             part, if they touch. So a capsule that lies on a face or along another stands on two
//
// Not in the notes.
#include "08_pairs/pairs.hpp"

namespace spook {

/// A capsule where it is now.
struct PlacedCapsule {
  int body;
  Vec3 x;              ///< centre [m]
  Vec3 axis;           ///< unit vector along its segment
  double radius;       ///< [m]
  double half_length;  ///< [m]

  /// Returns the ball at x(t).
  Ball ball(double t) const { return {.body = body, .x = x + t * half_length * axis, .radius = radius}; }
};

Bounds bounds(const PlacedCapsule& capsule);

/// Appends the contacts of a plane (body i) with a capsule (body j): of those ends that touch it.
void plane_capsule(const Plane& plane, const PlacedCapsule& capsule, std::vector<Contact>& contacts);

/// Appends the contact of a capsule (body i) with a ball (body j), if they touch.
void capsule_ball(const PlacedCapsule& capsule, const Ball& ball, std::vector<Contact>& contacts);

/// Appends the contacts of two capsules, three at most.
void capsule_capsule(const PlacedCapsule& i, const PlacedCapsule& j, std::vector<Contact>& contacts);

/// Appends the contacts of a box (body i) with a capsule (body j), three at most.
void box_capsule(const Box& box, const PlacedCapsule& capsule, std::vector<Contact>& contacts);

}  // namespace spook
