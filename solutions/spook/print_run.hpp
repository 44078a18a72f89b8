#pragma once
// The output of `spook run`.
#include <ostream>

#include "scenes/run.hpp"

namespace spook {

/// Prints the result as text of at most 80 columns, some ten lines; if `verbose`, with the scene's parameters and
/// answer, all numbers of the final state, and the time of each stage.
void print_text(std::ostream& out, const SceneDescription& scene, const Parameters& parameters,
                const RunSettings& settings, const RunResult& result, bool verbose);

/// Prints the result as one JSON object. If the scene has no rows, the solver is "none" and the residual is null.
/// Numbers that are not finite are null, too.
void print_json(std::ostream& out, const SceneDescription& scene, const Parameters& parameters,
                const RunSettings& settings, const RunResult& result);

}  // namespace spook
