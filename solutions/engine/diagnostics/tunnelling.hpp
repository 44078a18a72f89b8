#pragma once
// Tunnelling: a body is so fast that it may pass through another between two searches for contacts.
//
//   way               of i relative to j in a step [m], in the axes of j, which turn
//   detected_within   the sum of both sizes [m]: within it the bodies have a contact, which pushes the right way
//   tunnelling        way > detected_within, and the centre of one moves into the shape of the other
//
// Candidates are pairs of solids whose bounds along the way overlap, found by sweep and prune, Eq. (8.12). Without a
// body of which a point moves by more than its size there is no search. Nothing passes a plane, which is a half-space.
// Bodies that joints at points connect are left out: those of a fast mechanism turn together, on ways that are not
// straight.
#include <optional>
#include <vector>

#include "engine/world/world.hpp"

namespace spook {

struct Tunnelling {
  int body, other;
  double way, detected_within;  ///< [m]
  double longest_step;          ///< the longest step that would find the contact, over this step
};

/// Returns the first tunnelling body of the last step, of `h` [s]. `before` are the positions before it, `shapes` and
/// `sizes` those of the bodies.
template <int Dof>
std::optional<Tunnelling> find_tunnelling(const World<Dof>& world, const std::vector<Vec3>& before,
                                          const std::vector<Shape>& shapes, const std::vector<double>& sizes,
                                          double h);

}  // namespace spook
