#pragma once
// Bodies of points that pass through other bodies. Their points collide with planes only, so nothing else stops them.
//
//   passes    a point or the centre of one body is inside the other one, by more than a hundredth of the other's size
//   inside    of a body of points: inside the box around its points, along the body's axes
//
// Bodies that joints connect, and bodies that a list excludes from contacts, may overlap by intent.
#include <optional>
#include <utility>
#include <vector>

#include "engine/world/world.hpp"

namespace spook {

/// Returns the first body of points that passes through another body, and this other body. `shapes` are those of the
/// bodies. Candidates are found by sweep and prune, Eq. (8.12); a world without points pays nothing.
template <int Dof>
std::optional<std::pair<int, int>> find_passing_points(const World<Dof>& world,
                                                       const std::vector<Shape>& shapes);

}  // namespace spook
