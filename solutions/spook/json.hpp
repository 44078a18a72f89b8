#pragma once
// Parameters and methods of scenes as JSON.
#include <nlohmann/json.hpp>

#include "scenes/scene.hpp"

namespace spook {

using Json = nlohmann::ordered_json;

/// Returns [x, y, z].
Json numbers(const Vec3& v);

/// The names of orders of rows, in the order of RowOrder.
const std::vector<std::string>& row_orders();
const std::string& name_of(RowOrder order);

Json to_json(const Parameter& parameter);

/// Returns an object of names and values.
Json to_json(const Parameters& parameters);

/// Returns an object of solver, iterations, ..., tangents; null if the scene has no rows.
Json to_json(const Method& method, bool solves);

}  // namespace spook
