#pragma once
// Chapter 08 · Finding pairs: which bodies touch, where, how deep, and in which direction
//
// The broad phase discards nearly all pairs, by boxes along the axes of the world. The narrow phase computes the
// contact set of each remaining pair: points, signed gaps, and a normal from body i to body j.
//
//   plane, ball      g = n·x - offset - R                                          Eq. (8.1)    notes (21)
//   ball, ball       g = |x_j - x_i| - R_i - R_j,  n along x_j - x_i               Eq. (8.2)    notes (21)
//   contact point    r_i = p - x_i,  r_j = p - x_j: one p for both                 Eq. (8.3)    not in the notes
//   plane, box       g = n·p - offset of each of 8 corners p                       Eq. (8.4)    not in the notes
//   box, ball        n from the box's nearest point c to x_j,  g = |x_j - c| - R   Eq. (8.5)    not in the notes
//   along an axis    g(n) = |n·(x_j - x_i)| - ρ_i(n) - ρ_j(n),  ρ(n) = Σ h_k |n·e_k|
//                                                                                  Eq. (8.6)    not in the notes
//   separating axis  the largest g(n) of 15: 3 + 3 faces, 9 pairs of edges         Eq. (8.7)    not in the notes
//   clipping         the part of a polygon with n·x <= offset                      Eq. (8.8)    not in the notes
//   two edges        the points of two lines that are nearest to each other        Eq. (8.9)    not in the notes
//   held load        within the hull of the contacts that push                     Eq. (8.10)   not in the notes
//   bounds           x ± Σ h_k |e_k|                                               Eq. (8.11)   not in the notes
//   sweep and prune  in order along one axis, neighbours only are compared         Eq. (8.12)   "sweep-and-prune"
//   level            cells of 2^l, the smallest 2^l >= the size of a body          Eq. (8.13)   not in the notes
//   spatial hash     only those that share a cell are compared                     Eq. (8.14)   "spatial hashing"
//   rate             dg/dt = n·u + dn/dt·(p_j - p_i), and the last term is zero    Eq. (8.15)   notes (22), (23)
//
//   x   centre [m]       e_k   unit axes of a box, in the world       R   radius [m]
//   g   signed gap [m]   h_k   halves of its sides [m]                p   contact point [m]
//
// Differs from the notes: (21) is the gap of two points, one on each surface. Here the gap is a separate number, and
// r_i and r_j end at the same point, so that no impulse changes the angular momentum of the two bodies. Shapes are not
// checked: unit vectors have length 1, axes are at right angles, radii and half sides are positive. A shape at NaN
// touches nothing, by the rules of chapters/NUMBERS.md. Only the broad phase checks its input.
#include <optional>
#include <utility>
#include <vector>

#include "07_impacts/impacts.hpp"

namespace spook {

/// A half-space: all points with n·x < offset are solid. It belongs to a static body.
struct Plane {
  int body;
  Vec3 x;         ///< centre of that body [m]; the plane need not go through it
  Vec3 n;         ///< unit normal, outwards
  double offset;  ///< along n, from the origin [m]
};

struct Ball {
  int body;
  Vec3 x;         ///< centre [m]
  double radius;  ///< [m]
};

struct Box {
  int body;
  Vec3 x;           ///< centre [m]
  Mat3 axes;        ///< its unit axes e_k, as columns, in the world
  Vec3 half_sides;  ///< h_k [m]
};

/// Exercise 8.1. The contact of a plane (body i) with a ball (body j) if g <= 0: Eq. (8.1), (8.3); notes (21). p is
/// the ball's deepest point.
std::optional<Contact> plane_ball(const Plane& plane, const Ball& ball);

/// Exercise 8.2. The contact of two balls if g <= 0: Eq. (8.2), (8.3); notes (21). p is in the middle of their overlap.
/// If the two centres coincide, n may be any unit vector, with g = -R_i - R_j.
std::optional<Contact> ball_ball(const Ball& i, const Ball& j);

/// Exercise 8.3. Appends a contact for each corner of a box (body j) with g <= 0 above a plane (body i), in any
/// order: Eq. (8.3), (8.4); not in the notes. p is the corner.
void plane_box(const Plane& plane, const Box& box, std::vector<Contact>& contacts);

/// Exercise 8.4. The contact of a box (body i) with a ball (body j) if g <= 0: Eq. (8.3), (8.5); not in the notes. p is
/// in the middle of the overlap, on the line along n through the ball's centre. If the centre is in the box, or on its
/// surface, n is the normal of the nearest face, and g is the (negative) distance from that face, minus R.
std::optional<Contact> box_ball(const Box& box, const Ball& ball);

/// An axis, and the gap of two boxes along it.
struct SeparatingAxis {
  Vec3 n;      ///< unit vector, from i to j
  double gap;  ///< g(n) of Eq. (8.6) [m]. Positive if they do not touch; -∞ for a NaN, all indices then -1
  int face_i = -1;  ///< 0 to 2: n is along this axis of i; the contact is on the face of i across it
  int face_j = -1;  ///< 0 to 2: n is along this axis of j; the contact is on the face of j across it
  int edge_i = -1;  ///< 0 to 2: n is perpendicular to this axis of i, and to edge_j of j
  int edge_j = -1;  ///< of the four indices, either one face or both edges are not -1
};

/// Exercise 8.5. Finds the one of 15 axes along which two boxes overlap least: Eq. (8.6), (8.7); not in the notes.
///
/// Ties are broken so that round-off and sag do not choose between faces that lie on each other. Let the margin be a
/// thousandth of the smallest of all six half sides. Take the best face of i, that of j, and the best pair of edges; of
/// faces that are equal within the margin, the first counts. Start with the face of i. The face of j replaces it only
/// if its gap is larger by more than the margin plus 5 per cent of the absolute value of the first gap. By the same rule the edges may
/// replace the face that is kept. Parallel edges, |e × e'| <= 1e-6, have no axis. If axes have g > 0, returns any of
/// them, without a margin.
SeparatingAxis separating_axis(const Box& i, const Box& j);

/// Exercise 8.6. Clips a convex polygon, three or more corners in order, to n·x <= offset: Eq. (8.8); not in the notes.
/// Returns its corners in the order of the polygon, each once, starting anywhere. A corner on the plane stays. Empty if
/// nothing is left.
std::vector<Vec3> clip(const std::vector<Vec3>& polygon, const Vec3& n, double offset);

/// Exercise 8.7. The contact of two edges, edge_i of box i and edge_j of box j: Eq. (8.3), (8.9); not in the notes. Of
/// the four edges of i along axes.col(edge_i) it is the farthest along n, of those of j the farthest along -n. p is in
/// the middle between the points of the two edges, as straight lines, that are nearest to each other. n and the gap are
/// those of the axis. The edges are not parallel. Only x_j - x_i matters, so the accuracy is the same far from the
/// origin.
Contact edge_contact(const Box& i, const Box& j, const SeparatingAxis& axis);

/// Exercise 8.8. Appends the contacts of two boxes, at most eight, and at least one if they overlap: Eq. (8.3),
/// (8.6)-(8.10); not in the notes. Each p is in the middle between the two surfaces, along n.
///   face     the incident face is that of the other box with the normal most opposite to n. It is clipped by the planes
///            of the four sides around the reference face. Each of its corners with g <= 0 is a contact. Then go
///            around them once. While more than four are left, leave out one whose p is closer to the line through
///            those of its present neighbours than a fiftieth of the smallest of all six half sides
///   edges    one contact, by edge_contact. But take the first face whose normal is within 8 degrees of the edges' n,
///            cosine 0.99 or more, i's faces before j's. If it has at least two contacts, they are the contacts; no
///            other face is tried
///   neither  if clipping leaves no corner with g <= 0: a contact at each corner of the whole incident face with g <= 0,
///            or only at the deepest one
/// The sides are moved outwards by a millionth of the smallest of all six half sides, so that sides that lie on each other are not
/// clipped. Where the rules treat i and j differently, the box with the lower body number takes the role of i:
/// box_box(j, i) equals box_box(i, j), with the two bodies exchanged and n reversed. Only x_j - x_i matters, so the
/// accuracy is the same far from the origin.
void box_box(const Box& i, const Box& j, std::vector<Contact>& contacts);

/// A box along the axes of the world.
struct Bounds {
  Vec3 lower, upper;  ///< [m]
};

/// Exercise 8.9. The smallest bounds of a box: Eq. (8.11); not in the notes.
Bounds bounds(const Box& box);

/// Indices of two bodies, the lower first.
using Pair = std::pair<int, int>;

/// Exercise 8.10. Returns all pairs of bounds that overlap or touch, each once, sorted: Eq. (8.12); notes,
/// "sweep-and-prune". The time is proportional to N log N plus the number of pairs that overlap along one axis. It is
/// the axis along which the centres are spread farthest. Throws std::invalid_argument that names lower or upper if one
/// is not finite, and upper if it is below its lower.
std::vector<Pair> sweep_and_prune(const std::vector<Bounds>& bounds);

/// Exercise 8.11. Returns the same pairs as sweep_and_prune, by the cells of grids, with one grid for each level of
/// size: Eq. (8.13), (8.14); notes, "spatial hashing". A body's size is its longest side. The time is proportional to
/// the number of bodies plus the number of pairs that share a cell, for any mixture of sizes. Throws as sweep_and_prune
/// does.
std::vector<Pair> spatial_hash(const std::vector<Bounds>& bounds);

/// Exercise 8.12. Finds the contacts of all bodies at t_n, Eq. (8.1)-(8.12), then continues as the step of chapter
/// 07. Contacts of planes come first, plane by plane, then those of each pair of balls and boxes, in the order of
/// the pairs. Two static bodies have no contacts. Returns what step_impacts returns. Throws std::invalid_argument as
/// step_impacts does.
SolveReport step_pairs(Simulation& simulation, double h);

}  // namespace spook
