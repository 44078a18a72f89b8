#pragma once
// Chapter 06 · Distances, joints, ropes and cloth
//
// Constraints that pull as well as push, so they need no projection.
//
//   points       p = x + r of each body                                   Eq. (6.1)
//   distance     g = |p_j - p_i| - l,  n = (p_j - p_i)/|p_j - p_i|        Eq. (6.2)    notes, "Distance constraint"
//   its row      G = (-n, -r_i×n, n, r_j×n)                               Eq. (6.3)    notes (25)
//   bounds       -∞ < λ < ∞                                               Eq. (6.4)
//   ball joint   g = p_j - p_i, three rows                                Eq. (6.5)    not in the notes
//   their rows   Eq. (6.3) with e1, e2, e3 for n                          Eq. (6.6)    not in the notes
//   tension      T = -λ/h                                                 Eq. (6.7)
//   point's mass half of that of its links, a quarter of its cells'       Eq. (6.10), (6.11)
//
//   x   centre of mass [m]          r   from it to the point, in world coordinates [m]
//   l   target distance [m]         n   from i's point to j's
//
// Differs from the notes: a distance and a ball joint are two constraints, of one row and of three. If the two points
// coincide, a distance constraint has no direction n, and the function throws.
#include <array>
#include <vector>

#include "05_friction_box/friction_box.hpp"

namespace spook {

/// A point of a body: Eq. (6.1).
struct Attachment {
  int body;
  Vec3 x;                 ///< the body's centre of mass [m]
  Vec3 r = Vec3::Zero();  ///< from it to the point, in world coordinates [m]; zero for a point mass
};

/// Exercise 6.1. Holds two points at `length` [m] from each other: Eq. (6.2)-(6.4); notes, "Distance constraint".
/// Throws std::invalid_argument that names length if it is not positive and finite, and one that names distance if the
/// distance of the two points is not.
template <int Dof>
Constraint<Dof> distance_constraint(const Attachment& i, const Attachment& j, double length,
                                    const SpookParameters& spook);

/// Exercise 6.2. Holds two points together, in x, y and z: Eq. (6.4)-(6.6); not in the notes. They may have any
/// distance, zero included.
template <int Dof>
std::array<Constraint<Dof>, 3> ball_joint_constraints(const Attachment& i, const Attachment& j,
                                                      const SpookParameters& spook);

/// Two points of a net and their distance.
struct Link {
  int i, j;       ///< indices of points, i ≠ j
  double length;  ///< at rest [m]
};

/// Point masses with links between them: a rope, a cloth.
struct Net {
  std::vector<Vec3> x;       ///< [m]
  std::vector<double> mass;  ///< [kg]
  std::vector<Link> links;
};

/// Exercise 6.3. A straight rope from `from` to `to`, of `links` equal links and links + 1 points: Eq. (6.10). Link k
/// joins points k and k + 1, and its length is their distance. `mass` [kg] is the whole rope's. Throws
/// std::invalid_argument that names the parameter, unless links >= 1, mass is positive and finite, the ends are finite,
/// and their distance, named length, is positive.
Net rope(const Vec3& from, const Vec3& to, int links, double mass);

/// Exercise 6.4. A flat cloth of cells_u × cells_v cells, with links along the sides of every cell, each once, and no
/// diagonals: Eq. (6.11). Its corners are `corner`, corner + u, corner + v and corner + u + v; the point (a, b), a from
/// 0 to cells_u along u and b from 0 to cells_v along v, has the index a + b (cells_u + 1). `mass` [kg] is the whole
/// cloth's. The length of each link is the distance of its points. The links may be in any order. Throws
/// std::invalid_argument, naming the parameter, unless cells_u >= 1, cells_v >= 1, mass is positive and finite, corner,
/// u and v are finite, and area, |u × v|, is positive.
Net cloth(const Vec3& corner, const Vec3& u, const Vec3& v, int cells_u, int cells_v, double mass);

/// Exercise 6.5. Adds joints to the step of chapter 05. Their rows come first, in order, each joint with its own k
/// and d: Eq. (6.1)-(6.6). Returns the report of solve. Throws std::invalid_argument as step_friction,
/// distance_constraint and spook_parameters do, without changing anything.
SolveReport step_joints(Simulation& simulation, const std::vector<Contact>& contacts, double h);

}  // namespace spook
