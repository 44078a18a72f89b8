#pragma once
// The load of a body.
#include "engine/world/world.hpp"

namespace spook {

/// The load of body `below` in the last step of `h` [N]: the sum of the normal forces of contacts whose body i is
/// `below`.
inline double load_on(int below, const World<6>& world, double h) {
  double impulse = 0;
  const int contacts = static_cast<int>(world.contacts().size());
  for (int c = 0; c < contacts; ++c)
    if (world.contacts()[static_cast<std::size_t>(c)].i == below) impulse += world.lambda(c);
  return impulse / (h / world.parts());
}

}  // namespace spook
