#include "spook/run_command.hpp"

#include <unistd.h>

#include <fstream>
#include <iostream>
#include <limits>
#include <stdexcept>

#include "scenes/number.hpp"
#include "scenes/registry.hpp"
#include "scenes/run.hpp"
#include "spook/print_run.hpp"

namespace spook {

static void assign(Parameters& parameters, const std::string& text) {
  const std::size_t equals = text.find('=');
  if (equals == 0 || equals == std::string::npos)
    throw std::invalid_argument("--set wants NAME=VALUE, but got \"" + text + "\"");
  const std::string name = text.substr(0, equals);
  if (name == "h" || name == "time")
    throw std::invalid_argument(name + " is not a parameter of a scene: use --" + name + " " +
                                text.substr(equals + 1));
  parameters.set(name, text.substr(equals + 1));
}

static RunSettings settings_of(const RunCommand& command, const SceneDescription& scene) {
  RunSettings settings{.method = {.h = scene.h, .solver = solvers<3>().front().name}, .time = scene.time};
  Method& method = settings.method;
  if (command.h) method.h = parse_number("h", *command.h);
  if (command.time) settings.time = parse_number("time", *command.time);
  if (command.solver) method.solver = *command.solver;
  if (command.iterations)
    method.stop.max_sweeps = parse_whole("iterations", *command.iterations, 1, std::numeric_limits<int>::max());
  if (command.tolerance) {
    method.stop.tolerance = parse_number("tolerance", *command.tolerance);
    if (method.stop.tolerance < 0)
      throw std::invalid_argument("tolerance must be at least 0, but is " + *command.tolerance);
  }
  find_solver<3>(method.solver);
  step_count(method.h, settings.time);
  return settings;
}

/// A percentage on a terminal; nothing where nobody looks.
static Progress progress_on_terminal() {
  if (!isatty(STDERR_FILENO)) return nullptr;
  return [](std::int64_t done, std::int64_t steps) {
    std::cerr << (done == steps ? "     " : std::to_string(100 * done / steps) + " %") << '\r' << std::flush;
  };
}

void RunCommand::execute(std::ostream& out) const {
  const SceneDescription& description = find_scene(scene);
  Parameters parameters(description.parameters);
  for (const std::string& text : set) assign(parameters, text);
  const RunSettings settings = settings_of(*this, description);

  std::ofstream file;
  if (csv) {
    description.build(parameters, settings.method);  // so that a refused scene leaves an older file alone
    file.open(*csv);
    if (!file) throw std::invalid_argument("csv \"" + *csv + "\" cannot be written");
  }
  const RunResult result =
      run(description, parameters, settings, csv ? &file : nullptr, progress_on_terminal());
  if (csv && !file.flush()) throw std::invalid_argument("csv \"" + *csv + "\" cannot be written to its end");

  const auto print = json ? print_json : print_text;
  print(out, description, parameters, settings, result);
}

}  // namespace spook
