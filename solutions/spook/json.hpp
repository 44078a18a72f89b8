#pragma once
// Parameters and methods of scenes as JSON. No function is named to_json: the library has functions of this name, which
// would also be tried, and version 3.11.3 cannot compile some of them for our types.
#include <nlohmann/json.hpp>

#include "scenes/scene.hpp"

namespace spook {

using Json = nlohmann::ordered_json;

/// Returns [x, y, z].
Json numbers(const Vec3& v);

/// The names of orders of rows, in the order of RowOrder.
const std::vector<std::string>& row_orders();
const std::string& name_of(RowOrder order);

Json json_of(const Parameter& parameter);

/// Returns an object of names and values.
Json json_of(const Parameters& parameters);

/// Returns an object of solver, iterations, ..., tangents; null if the scene has no rows.
Json json_of(const Method& method, bool solves);

}  // namespace spook
