#pragma once
// What a body carries.
#include "engine/world/world.hpp"

namespace spook {

/// What pressed on body `below`, the i of its contacts, in the last step of `h`: the sum along their normals [N].
inline double load_on(int below, const World<6>& world, double h) {
  double impulse = 0;
  const int contacts = static_cast<int>(world.contacts().size());
  for (int c = 0; c < contacts; ++c)
    if (world.contacts()[static_cast<std::size_t>(c)].i == below) impulse += world.lambda(c);
  return impulse / h;
}

}  // namespace spook
