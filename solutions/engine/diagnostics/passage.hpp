#pragma once
// Bodies that meet another within a step, faster than a search for contacts at its ends can see.
//
//   way    of i relative to j in a step [m]
//   seen   the sum of both sizes [m]: within it the bodies have a contact that pushes them apart on the right side
//   way > seen, and the centre of one moves into the shape of the other: it may come out on the far side
//
// Candidates are pairs of solids whose bounds along the way overlap, found by sweep and prune, Eq. (8.12). Without a
// body that moves by more than its own size there is no search. Nothing passes a plane, which is a half-space. Bodies
// do not turn on their way here.
#include <optional>
#include <vector>

#include "engine/world/world.hpp"

namespace spook {

struct Passage {
  int body, other;
  double way, seen;     ///< [m]
  double longest_step;  ///< of contacts that see it, as a part of the step
};

/// Returns the first passage of the last step. `before` are the positions before it, `shapes` and `sizes` those of the
/// bodies.
template <int Dof>
std::optional<Passage> find_passage(const World<Dof>& world, const std::vector<Vec3>& before,
                                    const std::vector<Shape>& shapes, const std::vector<double>& sizes);

}  // namespace spook
