#pragma once
// Finding contacts: which spheres, planes and corners touch, how deep, and in which direction. Every pair is looked at,
// but for corners, which only planes stop.
//
//   gap   (x_j + r_j - x_i - r_i)·n, signed; a contact is a pair with gap <= 0          Eq. (3.1)
//   n     unit normal, from body i to body j; out of a plane
//   r     from a body's centre to its own deepest point, so that the formula above is the gap
#include <vector>

#include "engine/bodies.hpp"

namespace spook {

/// Everything with n·x < offset is solid. A plane belongs to a fixed body.
struct Plane {
  int body;
  Vec3 n;         ///< unit normal, outwards
  double offset;  ///< along n, from the origin [m]
};

struct Sphere {
  int body;
  double radius;  ///< [m]
  bool fixed;     ///< it cannot move; two such have no contact
};

/// Points of a rigid body: a box, a disc.
struct Corners {
  int body;
  std::vector<Vec3> points;  ///< from the body's centre, in its axes [m]
};

struct Shapes {
  std::vector<Plane> planes;
  std::vector<Sphere> spheres;
  std::vector<Corners> corners;

  /// Whether anything can touch anything.
  bool may_touch() const {
    return spheres.size() > 1 || (!planes.empty() && !(spheres.empty() && corners.empty()));
  }
};

/// Replaces `contacts` with all that there are: of planes with spheres, with corners, then of spheres, in the order
/// in which the shapes were added. Those of one pair of bodies follow each other. Returns how many pairs were
/// looked at.
template <int Dof>
int find_contacts(const Shapes& shapes, const Bodies<Dof>& bodies, std::vector<Contact>& contacts);

}  // namespace spook
