#pragma once
// Scenes as JSON files; SCENES.md describes the format.
#include "scenes/scene.hpp"
#include "spook/json.hpp"

namespace spook {

/// Tells whether a scene's name is a file name: it ends with .json.
bool is_scene_file(const std::string& name);

/// Reads a scene from a file. Throws std::invalid_argument, naming the file and the path in it, for invalid content.
SceneDescription read_scene(const std::string& file);

/// Returns a scene of the registry, or reads it from a file.
SceneDescription scene_named(const std::string& name);

/// Writes the initial state of a scene as a file. Throws std::invalid_argument for a scene whose force is a formula.
Json scene_as_file(const SceneDescription& description, const Parameters& parameters, const Method& method);

}  // namespace spook
