#pragma once
// Scenes as JSON files: see SCENES.md for their form.
#include "scenes/scene.hpp"
#include "spook/json.hpp"

namespace spook {

/// Whether a scene is asked for by a file: its name ends with .json.
bool is_scene_file(const std::string& name);

/// The scene in a file. Throws std::invalid_argument, naming the file and the place in it, for whatever makes no sense.
SceneDescription read_scene(const std::string& file);

/// A scene of the registry, or of a file.
SceneDescription scene_named(const std::string& name);

/// The scene as a file, as it stands at its start. Throws std::invalid_argument for one whose force is a formula.
Json scene_as_file(const SceneDescription& description, const Parameters& parameters, const Method& method);

}  // namespace spook
