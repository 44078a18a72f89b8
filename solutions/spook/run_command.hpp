#pragma once
// `spook run`: what was typed, checked and carried out.
#include <optional>
#include <ostream>
#include <string>
#include <vector>

#include "scenes/run.hpp"

namespace spook {

/// Options as typed.
struct RunCommand {
  std::string scene;
  std::vector<std::string> set;
  std::optional<std::string> h, time, solver, iterations, tolerance, csv;
  std::optional<std::string> substeps, order, seed, margin, friction_model, tangents;
  std::optional<std::string> record, fps;
  bool warm_start = false;
  bool positions = false;
  bool json = false;
  bool strict = false;

  /// What was typed, as numbers. Throws std::invalid_argument for what makes no sense.
  Parameters parameters(const SceneDescription& description) const;
  RunSettings settings(const SceneDescription& description) const;

  /// Types an option anew by its name, or else a scene's parameter. Throws std::invalid_argument for a choice of
  /// warm_start that is none.
  void retype(const std::string& name, const std::string& value);

  /// Runs and prints to `out`.
  /// Throws std::invalid_argument for whatever makes no sense, before anything is written; Blowup when the run
  /// does; and, with `strict`, std::runtime_error after a run that is not sound.
  void execute(std::ostream& out) const;
};

}  // namespace spook
