#pragma once
// A step that returns what became of it, for programs that go on after a world has diverged.
#include <optional>

#include "engine/world/world.hpp"

namespace spook {

/// Takes a step of h [s]. Returns the SimulationDiverged that step() would throw, or an empty optional. Throws
/// std::invalid_argument for h, as step() does.
template <int Dof>
[[nodiscard]] std::optional<SimulationDiverged> try_step(World<Dof>& world, double h) {
  try {
    world.step(h);
    return {};
  } catch (const SimulationDiverged& diverged) {
    return diverged;
  }
}

}  // namespace spook
