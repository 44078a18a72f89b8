#pragma once
// What `spook run` prints.
#include <ostream>

#include "scenes/run.hpp"

namespace spook {

/// At most 80 columns wide.
void print_text(std::ostream& out, const SceneDescription& scene, const Parameters& parameters,
                const RunSettings& settings, const RunResult& result);

/// One object. Without rows in the scene the solver is "none" and the residual null; so is a number that is not
/// finite.
void print_json(std::ostream& out, const SceneDescription& scene, const Parameters& parameters,
                const RunSettings& settings, const RunResult& result);

}  // namespace spook
