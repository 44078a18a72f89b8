#pragma once
// Contact search for planes, spheres, capsules, boxes and corners: chapter 08.
//
//   margin   slightly open contacts are found, too: engine/collision/placed_solids.hpp
//   planes   with every solid and corner; corners touch planes only
//   others   broad phase, then the contact set of each candidate pair:
//              up to 32 of them    all pairs whose bounds touch                             Eq. (8.11)
//              up to 2000          sweep and prune                                          Eq. (8.12)
//              more                spatial hash                                             Eq. (8.13), (8.14)
//            with enlarged bounds, valid until a body leaves its own: engine/collision/pair_cache.hpp
//   excluded pairs are skipped before their shapes are compared: engine/collision/exclusions.hpp
//   ghosts   contacts with the inner edges of flush boxes are removed: engine/collision/ghost_contacts.hpp
#include <vector>

#include "08_pairs/pairs.hpp"
#include "engine/bodies/bodies.hpp"
#include "engine/collision/exclusions.hpp"
#include "engine/collision/pair_cache.hpp"
#include "engine/collision/placed_solids.hpp"

namespace spook {

/// Points of a rigid body that touch planes only, such as those of a disc.
struct Corners {
  int body;
  std::vector<Vec3> points;  ///< from the body's centre, in its axes [m]
};

struct Shapes {
  std::vector<Plane> planes;
  std::vector<Solid> solids;
  std::vector<Corners> corners;
  Exclusions exclusions;  ///< bodies that do not touch each other
  /// The smallest size of all dynamic bodies [m], see size_of; infinite if there is none.
  double smallest = infinity;

  /// Adds the shape of a body.
  void add(int body, const Shape& shape, bool is_static);

  /// Returns the shapes of bodies 0 to bodies - 1; NoShape for planes.
  std::vector<Shape> by_body(std::size_t bodies) const;

  /// Removes the shape of a body. The indices of later bodies decrease by one.
  void remove(int body);

  /// Tells whether any two shapes can touch.
  bool may_touch() const {
    return solids.size() > 1 || (!planes.empty() && !(solids.empty() && corners.empty()));
  }
};

/// Finds contacts step by step, and keeps near pairs between steps.
class ContactFinder {
 public:
  /// Replaces `contacts` with all contacts of a gap of at most `margin` [m]: planes with solids, solids with solids,
  /// planes with corners, in the order in which the shapes were added. Contacts of one pair of bodies are consecutive.
  /// Returns the number of pairs that may touch by their bounds. The result is the same for any number of `threads`.
  template <int Dof>
  int find(const Shapes& shapes, const Bodies<Dof>& bodies, double margin, std::vector<Contact>& contacts,
           int threads = 1);

  /// Does the same after only the bodies marked in `moved` have changed since the last call, which found `contacts` in
  /// their order. Keeps the contacts of two solids that did not move.
  template <int Dof>
  int find_moved(const std::vector<bool>& moved, const Shapes& shapes, const Bodies<Dof>& bodies, double margin,
                 std::vector<Contact>& contacts, int threads = 1);

 private:
  void remove_ghosts(const Shapes& shapes, std::size_t bodies, std::vector<Contact>& contacts);

  PairCache pair_cache_;
  std::vector<bool> everyone_;
  std::vector<PlacedSolid> placed_;  // the solids where they are now
  std::vector<Bounds> bounds_;       // of the solids
  std::vector<Contact> last_;
  // Contacts of the last call before ghosts were removed; empty if there were no ghosts.
  std::vector<Contact> with_ghosts_;
  std::vector<std::vector<Contact>> found_;              // by each thread, of two solids
  std::size_t first_of_solids_ = 0, end_of_solids_ = 0;  // range of contacts of two solids
};

}  // namespace spook
