#pragma once
// `spook run`: checks the options and runs a scene.
#include <optional>
#include <ostream>
#include <string>

#include "scenes/typed_run.hpp"

namespace spook {

/// The options of the command, as typed.
struct RunCommand : TypedRun {
  std::optional<std::string> csv, record, fps, checkpoint, restart;
  bool positions = false;
  bool json = false;
  bool strict = false;
  bool verbose = false;

  /// Runs the scene and prints to `out`. Throws std::invalid_argument for an invalid option, before it writes anything;
  /// SimulationDiverged if the run diverges; and, with `strict`, std::runtime_error after a run that is not sound.
  void execute(std::ostream& out) const;
};

}  // namespace spook
