#pragma once
// `spook run`: what was typed, checked and carried out.
#include <optional>
#include <ostream>
#include <string>
#include <vector>

namespace spook {

/// Options as typed.
struct RunCommand {
  std::string scene;
  std::vector<std::string> set;
  std::optional<std::string> h, time, solver, iterations, tolerance, csv;
  std::optional<std::string> substeps, order, seed, margin, friction_model, tangents;
  bool warm_start = false;
  bool json = false;

  /// Runs and prints to `out`.
  /// Throws std::invalid_argument for whatever makes no sense, before anything is written; Blowup when the run
  /// does.
  void execute(std::ostream& out) const;
};

}  // namespace spook
