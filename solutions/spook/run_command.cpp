#include "spook/run_command.hpp"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iostream>
#include <limits>
#include <stdexcept>

#include "engine/near_miss.hpp"
#include "recording/recorder.hpp"
#include "scenes/number.hpp"
#include "scenes/registry.hpp"
#include "scenes/run.hpp"
#include "spook/print_run.hpp"
#include "spook/scene_file.hpp"

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
  if (method.margin && *method.margin < 0) throw std::invalid_argument("margin must be at least 0, but is " + *command.margin);
  if (command.friction_model)
    method.friction_model = choose<FrictionModel>(
        "friction-model", *command.friction_model,
        {{"box", FrictionModel::box}, {"two_pass", FrictionModel::two_pass}, {"cone", FrictionModel::cone}});
  if (command.tangents)
    method.sliding_tangents =
        choose<bool>("tangents", *command.tangents, {{"fixed", false}, {"sliding", true}});
}

Parameters RunCommand::parameters(const SceneDescription& description) const {
  Parameters parameters(description.parameters);
  for (const std::string& text : set) assign(parameters, text);
  return parameters;
}

RunSettings RunCommand::settings(const SceneDescription& description) const {
  RunSettings settings{.method = {.h = description.h, .solver = description.solver}, .time = description.time};
  Method& method = settings.method;
  if (h) method.h = parse_number("h", *h);
  if (time) settings.time = parse_number("time", *time);
  if (solver) method.solver = *solver;
  if (iterations)
    method.stop.max_sweeps = parse_whole("iterations", *iterations, 1, std::numeric_limits<int>::max());
  if (tolerance) {
    method.stop.tolerance = parse_number("tolerance", *tolerance);
    if (method.stop.tolerance < 0)
      throw std::invalid_argument("tolerance must be at least 0, but is " + *tolerance);
  }
  if (substeps) method.substeps = parse_whole("substeps", *substeps, 1, 1'000'000);
  set_rows(*this, method);
  // What has sweeps of its own is asked for instead of the scene's solver.
  if (!solver && method.has_own_sweeps()) method.solver = solvers<3>().front().name;
  make_solver<3>(method);
  step_count(method.h, settings.time);
  return settings;
}

/// A percentage on a terminal; nothing where nobody looks.
static std::function<void(std::int64_t, std::int64_t)> progress_on_terminal() {
  if (!isatty(STDERR_FILENO)) return nullptr;
  return [](std::int64_t done, std::int64_t steps) {
    std::cerr << (done == steps ? "     " : std::to_string(100 * done / steps) + " %") << '\r' << std::flush;
  };
}

void RunCommand::retype(const std::string& name, const std::string& value) {
  const std::vector<std::pair<std::string, std::optional<std::string>*>> options = {
      {"h", &h}, {"solver", &solver}, {"iterations", &iterations}, {"friction_model", &friction_model}};
  for (const auto& [option, typed] : options)
    if (option == name) {
      *typed = value;
      return;
    }
  if (name == "warm_start") {
    warm_start = choose<bool>(name, value, {{"on", true}, {"off", false}});
    return;
  }
  const auto names_it = [&](const std::string& text) { return text.rfind(name + "=", 0) == 0; };
  set.erase(std::remove_if(set.begin(), set.end(), names_it), set.end());
  set.push_back(name + "=" + value);
}

/// A file to write to. It is made once nothing else can be refused, so that an older one stays until then.
static void open(std::ofstream& file, const std::string& option, const std::optional<std::string>& name) {
  if (!name) return;
  file.open(*name);
  if (!file) throw std::invalid_argument(option + " \"" + *name + "\" cannot be written");
}

static void close(std::ofstream& file, const std::string& option, const std::optional<std::string>& name) {
  if (name && !file.flush())
    throw std::invalid_argument(option + " \"" + *name + "\" cannot be written to its end");
}

/// Beforehand, where it is much.
static void tell_size(const Recorder& recorder) {
  const double megabytes = recorder.expected_bytes() / 1e6;
  if (megabytes < 10) return;
  std::cerr << "spook: recording " << recorder.frames() << " frames, " << std::lround(megabytes)
            << " MB and more with contacts; --fps or --time make it less\n";
}

/// A run that blows up leaves a recording that says so, with its frames up to there.
template <class Run>
static RunResult recorded(Recorder& recorder, bool records, const Run& run) {
  try {
    const RunResult result = run();
    if (records) recorder.end();
    return result;
  } catch (const Blowup& blowup) {
    if (records) recorder.end(blowup.what());
    throw;
  }
}

void RunCommand::execute(std::ostream& out) const {
  const SceneDescription description = scene_named(scene);
  const Parameters parameters = this->parameters(description);
  const RunSettings settings = this->settings(description);
  if (fps && !record) throw std::invalid_argument("fps is for --record");
  if (positions && !csv) throw std::invalid_argument("positions is for --csv");
  const double per_second = fps ? parse_number("fps", *fps) : 60;
  steps_of_frame(settings.method.h, per_second);

  std::ofstream table, recording;
  if (csv || record) description.build(parameters, settings.method);
  open(table, "csv", csv);
  open(recording, "record", record);
  Recorder recorder(recording, description, parameters, settings, per_second);
  Watch watch{.csv = csv ? &table : nullptr, .positions = positions, .progress = progress_on_terminal()};
  if (record)
    watch.look = [&](Scene& now, std::int64_t substep) {
      recorder.look(now, substep);
      if (substep == 0) tell_size(recorder);
    };
  const RunResult result =
      recorded(recorder, record.has_value(), [&] { return run(description, parameters, settings, watch); });
  close(table, "csv", csv);
  close(recording, "record", record);

  const auto print = json ? print_json : print_text;
  print(out, description, parameters, settings, result);
  if (strict && result.verdict.state != State::sound)
    throw std::runtime_error("the run is " + name_of(result.verdict.state) + ": " + result.verdict.reason);
}

}  // namespace spook
