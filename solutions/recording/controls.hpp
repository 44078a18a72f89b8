#pragma once
// Parameters and options that a page can change while a scene runs.
#include "spook/json.hpp"

namespace spook {

/// Returns a list of controls: name, meaning, value, unit, and either low, high and logarithmic, or choices.
Json controls(const SceneDescription& description, const Parameters& parameters, const Method& method);

}  // namespace spook
