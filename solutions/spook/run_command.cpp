#include "spook/run_command.hpp"

#include <unistd.h>

#include <fstream>
#include <iostream>
#include <limits>
#include <stdexcept>

#include "engine/near_miss.hpp"
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

/// The value that `text` names.
template <class Value>
static Value choose(const std::string& option, const std::string& text,
                    const std::vector<std::pair<std::string, Value>>& choices) {
  std::vector<std::string> names;
  for (const auto& [name, value] : choices) {
    if (name == text) return value;
    names.push_back(name);
  }
  throw std::invalid_argument("unknown " + option + " \"" + text + "\"" + did_you_mean(text, names));
}

/// How the rows are made and swept.
static void set_rows(const RunCommand& command, Method& method) {
  if (command.order)
    method.order = choose<RowOrder>("order", *command.order,
                                    {{"given", RowOrder::given},
                                     {"up", RowOrder::up},
                                     {"down", RowOrder::down},
                                     {"random", RowOrder::random}});
  if (command.seed)
    method.seed =
        static_cast<std::uint64_t>(parse_whole("seed", *command.seed, 0, std::numeric_limits<int>::max()));
  method.warm_start = command.warm_start;
  if (command.margin) method.margin = parse_number("margin", *command.margin);
  if (method.margin < 0) throw std::invalid_argument("margin must be at least 0, but is " + *command.margin);
  if (command.friction_model)
    method.friction_model = choose<FrictionModel>(
        "friction-model", *command.friction_model,
        {{"box", FrictionModel::box}, {"two_pass", FrictionModel::two_pass}, {"cone", FrictionModel::cone}});
  if (command.tangents)
    method.sliding_tangents =
        choose<bool>("tangents", *command.tangents, {{"fixed", false}, {"sliding", true}});
}

static RunSettings settings_of(const RunCommand& command, const SceneDescription& scene) {
  RunSettings settings{.method = {.h = scene.h, .solver = scene.solver}, .time = scene.time};
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
  if (command.substeps) method.substeps = parse_whole("substeps", *command.substeps, 1, 1'000'000);
  set_rows(command, method);
  // What has sweeps of its own is asked for instead of the scene's solver.
  if (!command.solver && method.has_own_sweeps()) method.solver = solvers<3>().front().name;
  make_solver<3>(method);
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
