#pragma once
// Large structures of the comparison, which should stay as they are.
#include <string>

#include "engine/world/world.hpp"

namespace spook::peers {

/// The structures.
enum class Structure {
  pyramid,  ///< `size` cubes in the lowest course, one at the top
  field,    ///< size x size pyramids of five cubes in the lowest course, side by side
  wall,     ///< `size` courses of `size` bricks, every other one shifted by half a brick
  grid,     ///< a net of size x size bodies on ball joints, hanging from its fixed top row
};

/// Returns a structure at rest. Cubes have sides of 1 m and 100 kg, bricks 2 m x 1 m x 1 m and 200 kg, and touch exactly
/// (the bricks of a course are a thousandth apart). Bodies of the grid have 1 kg, and links of 1 m.
World<6> structure(Structure which, int size, Settings<6> settings);

}  // namespace spook::peers
