#pragma once
// Finding contacts: which spheres and planes touch, how deep, and in which direction. Every pair is looked at.
//
//   gap   (x_j + r_j - x_i - r_i)·n, signed; a contact is a pair with gap <= 0          Eq. (3.1)
//   n     unit normal, from body i to body j; out of a plane
//   r     from a body's centre to its own deepest point, so that the formula above is the gap
#include <vector>

#include "03_single_contact/single_contact.hpp"

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

struct Shapes {
  std::vector<Plane> planes;
  std::vector<Sphere> spheres;
};

/// Replaces `contacts` with all that there are between bodies at `x`: planes first, then spheres, in the order in
/// which the shapes were added. Returns how many pairs were looked at.
int find_contacts(const Shapes& shapes, const std::vector<Vec3>& x, std::vector<Contact>& contacts);

}  // namespace spook
