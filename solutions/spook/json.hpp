#pragma once
// Parameters and methods of scenes as JSON.
#include <nlohmann/json.hpp>

#include "scenes/scene.hpp"

namespace spook {

using Json = nlohmann::ordered_json;

/// Returns [x, y, z].
Json numbers(const Vec3& v);

Json to_json(const Parameter& parameter);

/// Returns an object of names and values.
Json to_json(const Parameters& parameters);

/// Returns an object of solver, iterations, ..., tangents; null if the scene has no rows.
Json to_json(const Method& method, bool solves);

}  // namespace spook
