#pragma once
// Runs scenes for tests, as run() does, but without timing.
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "scenes/number.hpp"
#include "scenes/registry.hpp"
#include "scenes/run.hpp"

namespace spook {

using SceneSettings = std::vector<std::pair<std::string, std::string>>;

inline Parameters with(const SceneDescription& scene, const SceneSettings& settings) {
  Parameters parameters(scene.parameters);
  for (const auto& [name, value] : settings) parameters.set(name, value);
  return parameters;
}

/// A scene's output, a column by its name, including the start.
struct SceneRun {
  double error = 0;
  std::map<std::string, std::vector<double>> columns;

  const std::vector<double>& all(const std::string& column) const { return columns.at(column); }
  double last(const std::string& column) const { return all(column).back(); }
};

/// Uses the scene's own solver, unless another is named.
inline SceneRun run_of(const std::string& name, const SceneSettings& settings, double h, double time,
                       const StopRule& stop = {}, const std::string& solver = "") {
  const SceneDescription& description = find_scene(name);
  const auto scene = description.build(
      with(description, settings),
      {.h = h, .solver = solver.empty() ? description.solver : solver, .solver_limits = stop});
  const std::vector<std::string> names = scene->columns();
  SceneRun run;
  const std::int64_t steps = step_count(h, time);
  for (std::int64_t n = 0; n <= steps; ++n) {
    if (n > 0) scene->advance(1);
    scene->observe();
    const std::vector<double> values = scene->sample();
    for (std::size_t c = 0; c < names.size(); ++c) run.columns[names[c]].push_back(values.at(c));
  }
  run.error = scene->error();
  return run;
}

inline double error_of(const std::string& name, const SceneSettings& settings, double h, double time,
                       const StopRule& stop = {}, const std::string& solver = "") {
  return run_of(name, settings, h, time, stop, solver).error;
}

}  // namespace spook
