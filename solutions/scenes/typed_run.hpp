#pragma once
// A run as it is asked for in words: of a command line, of a page, of an experiment.
#include <optional>
#include <string>
#include <vector>

#include "scenes/run.hpp"

namespace spook {

/// Options as typed.
struct TypedRun {
  std::string scene;
  std::vector<std::string> set;
  std::optional<std::string> h, time, solver, iterations, tolerance;
  std::optional<std::string> substeps, integrator_order, row_order, seed, contact_margin, friction_model,
      tangents, threads, engine;
  bool warm_start = false;

  /// What was typed, as numbers. Throws std::invalid_argument for what makes no sense.
  Parameters parameters(const SceneDescription& description) const;
  RunSettings settings(const SceneDescription& description) const;

  /// Types an option anew by its name, or else a scene's parameter. Throws std::invalid_argument for a choice of
  /// warm_start that is none.
  void retype(const std::string& name, const std::string& value);
};

}  // namespace spook
