#pragma once
// A run described by text options: of a command line, a page or an experiment.
#include <optional>
#include <string>
#include <vector>

#include "scenes/run.hpp"

namespace spook {

/// The options of a run, as typed.
struct TypedRun {
  std::string scene;
  std::vector<std::string> set;
  std::optional<std::string> h, time, solver, iterations, tolerance, accuracy;
  std::optional<std::string> substeps, integrator_order, row_order, seed, contact_margin, friction_model,
      tangents, max_parts, threads, engine, soft_steps;
  bool warm_start = false;

  /// Converts the options to numbers. Throws std::invalid_argument for an invalid option.
  Parameters parameters(const SceneDescription& description) const;
  RunSettings settings(const SceneDescription& description) const;

  /// Replaces an option by its name, or else a parameter of the scene. Throws std::invalid_argument for a value of
  /// warm_start other than its choices.
  void retype(const std::string& name, const std::string& value);
};

}  // namespace spook
