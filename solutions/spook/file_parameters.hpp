#pragma once
// Parameters of a scene file: declared with a default, and named as "$NAME" in the place of a number.
#include <vector>

#include "scenes/parameters.hpp"
#include "spook/json.hpp"

namespace spook {

/// The parameters that a file declares. Throws std::invalid_argument, naming the place, for whatever makes no sense.
std::vector<Parameter> parameters_in(const Json& file);

/// The file with the values of its parameters in the place of "$NAME".
/// Throws std::invalid_argument for a name that is not declared, and for a parameter that is used nowhere.
Json with_values(const Json& file, const std::vector<Parameter>& parameters);

}  // namespace spook
