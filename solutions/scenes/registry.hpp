#pragma once
// All scenes. A new one is a file of its own, a line here, and a line in registry.cpp.
#include "scenes/scene.hpp"

namespace spook {

SceneDescription free_fall();
SceneDescription oscillator();
SceneDescription orbit();
SceneDescription top();
SceneDescription resting_sphere();
SceneDescription stack();

const std::vector<SceneDescription>& scenes();

/// Throws std::invalid_argument, with the nearest name there is, for a name that is no scene's.
const SceneDescription& find_scene(const std::string& name);

/// For SceneDescription::build.
template <class SomeScene>
std::unique_ptr<Scene> build_as(const Parameters& parameters, const Method& method) {
  return std::make_unique<SomeScene>(parameters, method);
}

}  // namespace spook
