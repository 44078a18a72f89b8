#pragma once
// A scene's numbers and its method, as JSON.
#include <nlohmann/json.hpp>

#include "scenes/scene.hpp"

namespace spook {

using Json = nlohmann::ordered_json;

/// x, y, z
Json numbers(const Vec3& v);

Json to_json(const Parameter& parameter);

/// name: value
Json to_json(const Parameters& parameters);

/// solver, iterations, ..., tangents; null where a scene has no rows.
Json to_json(const Method& method, bool solves);

}  // namespace spook
