#pragma once
// What can be turned while a scene runs.
#include "spook/json.hpp"

namespace spook {

/// A list: name, value, unit, and low, high and logarithmic, or choices.
Json controls(const SceneDescription& description, const Parameters& parameters, const Method& method);

}  // namespace spook
