#pragma once
#include "engine/world/world.hpp"
#include "peers/engines/engine.hpp"

namespace spook::peers {

std::unique_ptr<Engine> make_spook(std::unique_ptr<Scene> scene);

/// The same of a world without a scene, in steps of `h` [s].
std::unique_ptr<Engine> make_spook(World<6> world, double h);

}  // namespace spook::peers
