#pragma once
// A contact that a step found late: as it was when its two bodies touched, and as it is after they have moved on.
#include <vector>

#include "engine/collision/contacts.hpp"

namespace spook {

/// Returns the radius of each sphere among the bodies [m]; -1 for planes, and 0 for all others.
std::vector<double> radii_of(const Shapes& shapes, std::size_t bodies);

/// Returns the time since the gap was 0, Eq. (7.15) [s], for the normal velocity `u_n` [m/s] < 0. The delay of a chain
/// of impacts adds to that of the pair: at most `longest` [s].
template <int Dof>
double lateness(const Contact& contact, double u_n, double h, double longest, const Motion<Dof>& motion);

/// Returns the contact as it was `late` ago [s], with both lever arms to one point, and the normal of two spheres. The
/// point keeps its place on a sphere, and on a body that touches a plane; otherwise it is midway.
template <int Dof>
Contact contact_before(Contact contact, double late, const std::vector<double>& radii,
                       const Bodies<Dof>& bodies);

/// Displacements of bodies since their contacts were found.
struct Displacements {
  std::vector<Vec3> by, turned;  ///< of the centre [m]; about it [rad]

  Vec3 at(int body, const Vec3& r) const { return by[body] + turned[body].cross(r); }
};

/// Updates a contact after its bodies have moved: its two lever arms meet in one point again. That of body j stays if j
/// is a sphere or i a plane; otherwise that of body i stays.
Contact moved_on(Contact contact, const Displacements& moved, const std::vector<double>& radii);

}  // namespace spook
