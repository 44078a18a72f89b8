#pragma once
// Finding contacts: which planes, spheres, capsules, boxes and corners touch, how deep, and in which direction: chapter 08.
//
//   margin   contacts that are nearly closed are wanted, too: each shape grows by half the margin, and each gap by all
//            of it
//   planes   with every solid and corner; nothing else stops a corner
//   others   broad phase, then the contact set of each pair that it leaves:
//              up to 32 of them    all pairs whose bounds touch                             Eq. (8.11)
//              up to 2000          sweep and prune                                          Eq. (8.12)
//              more                spatial hash                                             Eq. (8.13), (8.14)
//            of bounds with room around them, which hold as long as nothing leaves its own: engine/collision/pair_cache.hpp
//   ghosts   contacts with the inner edges of flush boxes are left out: engine/collision/ghost_contacts.hpp
#include <variant>
#include <vector>

#include "08_pairs/pairs.hpp"
#include "engine/bodies/bodies.hpp"
#include "engine/collision/capsules.hpp"
#include "engine/collision/pair_cache.hpp"

namespace spook {

/// A shape that meets planes and all other solids, about the centre of a body.
struct Solid {
  int body;
  std::variant<Sphere, Capsule, Cuboid> shape;
  bool is_static;  ///< two such have no contact
};

/// Points of a rigid body: a disc, a box that meets planes only.
struct Corners {
  int body;
  std::vector<Vec3> points;  ///< from the body's centre, in its axes [m]
};

using PlacedSolid = std::variant<Ball, PlacedCapsule, Box>;

struct Shapes {
  std::vector<Plane> planes;
  std::vector<Solid> solids;
  std::vector<Corners> corners;
  /// The least size of what moves, as size_of says [m].
  double smallest = infinity;

  /// Adds the shape of a body.
  void add(int body, const Shape& shape, bool is_static);

  /// Returns the shape of each of so many bodies; none for a plane's.
  std::vector<Shape> by_body(std::size_t bodies) const;

  /// Takes the shape of a body out; bodies after it move up by one.
  void remove(int body);

  /// Whether anything can touch anything.
  bool may_touch() const {
    return solids.size() > 1 || (!planes.empty() && !(solids.empty() && corners.empty()));
  }
};

/// Finds contacts, in one step after another.
class ContactFinder {
 public:
  /// Replaces `contacts` with all that have a gap of at most `margin` [m]: of planes with solids, of solids, of planes
  /// with corners, in the order in which the shapes were added. Those of one pair of bodies follow each other. Returns
  /// how many pairs of shapes were looked at closely. What is found does not depend on `threads`.
  template <int Dof>
  int find(const Shapes& shapes, const Bodies<Dof>& bodies, double margin, std::vector<Contact>& contacts,
           int threads = 1);

  /// The same, where only the bodies that `moved` says are elsewhere than at the last call, and `contacts` are those that
  /// it found, in their order: what two solids have that did not move is kept.
  template <int Dof>
  int find_moved(const std::vector<bool>& moved, const Shapes& shapes, const Bodies<Dof>& bodies, double margin,
                 std::vector<Contact>& contacts, int threads = 1);

 private:
  void remove_ghosts(const Shapes& shapes, std::size_t bodies, double grown, std::vector<Contact>& contacts);

  PairCache neighbours_;
  std::vector<bool> everyone_;
  std::vector<PlacedSolid> placed_;  // the solids where they are now, each grown by half the margin
  std::vector<Bounds> bounds_;       // of the solids
  std::vector<Contact> last_;
  std::vector<Contact> with_ghosts_;                     // of the last call; empty if there were none
  std::vector<std::vector<Contact>> found_;              // of two solids, by each thread
  std::size_t first_of_solids_ = 0, end_of_solids_ = 0;  // which of the contacts are those of two solids
};

}  // namespace spook
