#pragma once
// The output of `spook run`.
#include <ostream>

#include "scenes/run.hpp"

namespace spook {

/// Prints the result as text of at most 80 columns.
void print_text(std::ostream& out, const SceneDescription& scene, const Parameters& parameters,
                const RunSettings& settings, const RunResult& result);

/// Prints the result as one JSON object. If the scene has no rows, the solver is "none" and the residual is null.
/// Numbers that are not finite are null, too.
void print_json(std::ostream& out, const SceneDescription& scene, const Parameters& parameters,
                const RunSettings& settings, const RunResult& result);

}  // namespace spook
