#pragma once
#include "peers/engines/engine.hpp"

namespace spook::peers {

std::unique_ptr<Engine> make_spook(std::unique_ptr<Scene> scene);

}  // namespace spook::peers
