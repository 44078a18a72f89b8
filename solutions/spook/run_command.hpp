#pragma once
// `spook run`: what was typed, checked and carried out.
#include <optional>
#include <ostream>
#include <string>

#include "scenes/typed_run.hpp"

namespace spook {

/// Options as typed.
struct RunCommand : TypedRun {
  std::optional<std::string> csv, record, fps;
  bool positions = false;
  bool json = false;
  bool strict = false;

  /// Runs and prints to `out`.
  /// Throws std::invalid_argument for whatever makes no sense, before anything is written; SimulationDiverged when the run
  /// does; and, with `strict`, std::runtime_error after a run that is not sound.
  void execute(std::ostream& out) const;
};

}  // namespace spook
