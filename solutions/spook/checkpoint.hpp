#pragma once
// Checkpoints: files from which a run continues in another process, with the same bits.
//
//   first line   JSON: the run that it belongs to, and the substeps so far
//   the rest     bytes_of_state of the scene: engine/support/state_stream.hpp
#include <string>

#include "scenes/run.hpp"
#include "spook/json.hpp"

namespace spook {

/// Describes all that a run must share with the run that it continues: scene, parameters and method. The time and the
/// number of threads may differ. `scene` is the name or the file of the scene; a file must have the same text.
Json identity_of_run(const std::string& scene, const SceneDescription& description,
                     const Parameters& parameters, const Method& method);

/// Throws std::invalid_argument, naming the file, if it cannot be written. Leaves an older file as it is.
void require_writable_checkpoint(const std::string& file);

/// Writes the state of a scene after so many substeps. The file is complete, or stays as it was. Throws
/// std::invalid_argument, naming the file, if it cannot be written.
void write_checkpoint(const std::string& file, const Json& run, std::int64_t substep, Scene& scene);

/// Reads a checkpoint of the same run. Throws std::invalid_argument, naming the file, if it cannot be read, is no
/// checkpoint, is damaged, or belongs to another run; then the message names the first difference.
RunStart read_checkpoint(const std::string& file, const Json& run);

}  // namespace spook
