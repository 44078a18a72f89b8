// Speed against error for any scene: one point for each combination of options.
//
//   --scene NAME --set name=value ...     a scene, or a file.json, and its parameters (a stack of ten spheres)
//   --solver A,B --iterations 10,100 --h 1/60,1/120 --row-order up,random --warm-start=off,on ...
//
// The options of ./course run for the scene and the solver, and all parameters of the scene, are available, each with
// one or more values: one point for each combination, as in ./course run --sweep. ./course plot also accepts the same
// --sweep NAME=A,B. Refused combinations are skipped and counted. The error is the scene's own, so a file must have an
// answer, its "expected". The cost is the median of the microseconds per step with its quartiles, and the row updates
// per second, which are the same on every machine. A run that diverges is lost: its error is infinite, and it has no
// cost.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <fstream>
#include <iostream>
#include <map>
#include <set>
#include <sstream>

#include "engine/world/world.hpp"
#include "machinery/experiment.hpp"
#include "scenes/number.hpp"
#include "scenes/registry.hpp"
#include "scenes/typed_run.hpp"
#include "spook/scene_file.hpp"

namespace spook::plots {
namespace {

/// An option of run, and its values, separated by commas.
struct Option {
  std::string name, values, meaning;
  std::optional<std::string> TypedRun::*typed;
  bool tells = true;       ///< its value is part of the line's name
  std::string usual = "";  ///< its values, unless given
};

struct Chosen {
  std::string scene = "stack";
  std::vector<std::string> set;
  std::string time, warm_start = "off";
  // The first three leave no sweeps of a solver, so they are known before the solver and its iterations.
  std::vector<Option> options = {
      {"accuracy", "", "share of the right-hand side that auto may leave", &TypedRun::accuracy},
      {"soft-steps", "", "substeps of soft steps", &TypedRun::soft_steps},
      {"integrator-order", "", "order of a step: 2, or 4, composed of five leapfrogs",
       &TypedRun::integrator_order},
      {"solver", "", "solvers", &TypedRun::solver, true, "gauss_seidel"},
      {"h", "", "steps [s]", &TypedRun::h, false, "1/60,1/120,1/240"},
      {"substeps", "", "steps that each step is made of", &TypedRun::substeps},
      {"row-order", "", "of the rows: given, up, down, random, interleaved", &TypedRun::row_order},
      {"seed", "", "of a random order", &TypedRun::seed},
      {"contact-margin", "", "largest gaps of a contact [m]", &TypedRun::contact_margin},
      {"friction-model", "", "box, two_pass, cone", &TypedRun::friction_model},
      {"tangents", "", "fixed, sliding", &TypedRun::tangents},
      {"threads", "", "worker threads", &TypedRun::threads},
      {"engine", "", "fast, plain", &TypedRun::engine},
      {"tolerance", "", "stop sweeping at this [m/s]", &TypedRun::tolerance},
      {"max-parts", "", "largest number of parts of a step", &TypedRun::max_parts},
      {"iterations", "", "most sweeps in a step", &TypedRun::iterations, false, "10,30,100,300,1000"}};
};

/// A run, and the values that distinguish its line from others.
struct Asked {
  TypedRun run;
  std::string line;
  std::string all_have;                  ///< values common to all runs, other than the defaults
  std::vector<std::string> values = {};  ///< NAME=VALUE of each option with several values
};

/// The values of a list. Throws std::invalid_argument for a value that is there twice.
std::vector<std::string> parts(const std::string& name, const std::string& list) {
  std::vector<std::string> found;
  std::istringstream text(list);
  for (std::string part; std::getline(text, part, ',');) {
    if (std::find(found.begin(), found.end(), part) != found.end())
      throw std::invalid_argument(name + " has the value " + part + " twice: leave one out");
    found.push_back(part);
  }
  return found;
}

/// The values of an option for a run: the given ones, or the usual ones if they have an effect.
std::vector<std::string> values_of(const Option& option, const TypedRun& run, const SceneDescription& scene) {
  if (!option.values.empty()) return parts(option.name, option.values);
  const bool of_sweeps = option.name == "solver" || option.name == "iterations";
  const bool composed = run.integrator_order ? *run.integrator_order == "4" : scene.integrator_order == 4;
  if (of_sweeps && (run.accuracy || run.soft_steps || composed)) return {};
  if (option.name == "iterations" && !scene.solves) return {};
  return parts(option.name, option.usual);
}

/// Combines each of these runs with each value of the option.
std::vector<Asked> times(const std::vector<Asked>& some, const Option& option, const SceneDescription& scene,
                         bool quick) {
  std::vector<Asked> all;
  for (const Asked& asked : some) {
    std::vector<std::string> values = values_of(option, asked.run, scene);
    if (values.empty()) all.push_back(asked);
    if (quick && option.name == "iterations") values.resize(std::min<std::size_t>(values.size(), 3));
    for (const std::string& value : values) {
      all.push_back(asked);
      all.back().run.*option.typed = value;
      all.back().values.push_back(option.name + "=" + value);
      if (!option.tells) continue;
      std::string& text = values.size() > 1 || option.name == "solver" ? all.back().line : all.back().all_have;
      text += (text.empty() ? "" : " ") + (option.name == "solver" ? "" : option.name + " ") + value;
    }
  }
  return all;
}

/// Each of these with each value of a parameter, NAME=VALUE,VALUE.
std::vector<Asked> times(const std::vector<Asked>& some, const std::string& parameter) {
  const std::size_t equals = std::min(parameter.find('='), parameter.size() - 1);
  const std::vector<std::string> values = parts(parameter.substr(0, equals), parameter.substr(equals + 1));
  std::vector<Asked> all;
  for (const Asked& asked : some)
    for (const std::string& value : values) {
      all.push_back(asked);
      all.back().run.set.push_back(parameter.substr(0, equals + 1) + value);
      if (values.size() == 1) continue;
      all.back().values.push_back(all.back().run.set.back());
      all.back().line += (asked.line.empty() ? "" : " ") + all.back().run.set.back();
    }
  return all;
}

std::vector<Asked> all_runs(const Chosen& chosen, const SceneDescription& scene, bool quick) {
  TypedRun first;
  first.scene = chosen.scene;
  if (chosen.set.empty() && chosen.scene == Chosen().scene) first.set = {"bodies=10"};
  if (!chosen.time.empty()) first.time = chosen.time;
  std::vector<Asked> all = {{first, "", ""}};
  for (const std::string& parameter : chosen.set) all = times(all, parameter);
  for (const Option& option : chosen.options) all = times(all, option, scene, quick);
  for (Asked& asked : all)
    // Without another solver the plain engine runs the first step that has all features of the scene, which sweeps.
    if (asked.run.engine == "plain" && asked.run.solver == "gauss_seidel") asked.run.solver.reset();
  std::vector<Asked> with_starts;
  for (const Asked& asked : all)
    for (const std::string& start : parts("warm-start", chosen.warm_start)) {
      with_starts.push_back(asked);
      with_starts.back().run.retype("warm_start", start);
      with_starts.back().values.push_back("warm-start=" + start);
      if (start == "on") with_starts.back().line += " warm";
    }
  return with_starts;
}

/// All that decides the result of a run: what was computed for another scene, file or option is not taken for it.
std::string key_of(const Chosen& chosen, const Asked& asked) {
  std::ostringstream key;
  key << chosen.scene;
  if (is_scene_file(chosen.scene)) {
    std::ostringstream content;
    content << std::ifstream(chosen.scene).rdbuf();
    key << ' ' << std::hex << std::hash<std::string>()(content.str());
  }
  for (const std::string& parameter : asked.run.set) key << ' ' << parameter;
  if (asked.run.time) key << " time=" << *asked.run.time;
  for (const Option& option : chosen.options)
    if (const auto& value = asked.run.*option.typed) key << ' ' << option.name << '=' << *value;
  if (asked.run.warm_start) key << " warm-start";
  return key.str();
}

/// Runs it. A run that diverges is lost, as in `./course run --sweep`.
RunResult result_of(const SceneDescription& scene, const Parameters& set, const RunSettings& settings) {
  try {
    return run(scene, set, settings);
  } catch (const SimulationDiverged&) {
    RunResult lost;
    lost.error = infinity;
    lost.verdict.state = State::lost;
    return lost;
  }
}

/// Computes the row of one run. Throws std::invalid_argument if its scene has no answer for such a run.
std::vector<Row> measured(const Asked& asked, const SceneDescription& scene, const Parameters& set,
                          const RunSettings& settings) {
  const RunResult result = result_of(scene, set, settings);
  if (std::isnan(result.error) && result.verdict.state != State::lost) {
    std::string values;
    for (const std::string& value : asked.values) values += " " + value;
    throw std::invalid_argument(scene.name + " has no error with" + values +
                                ": choose another scene, or use ./course run " + scene.name + " --sweep");
  }
  const std::string method = settings.method.soft_steps              ? "soft steps"
                             : settings.method.integrator_order == 4 ? "order four"
                                                                     : settings.method.solver;
  return {{scene.name, asked.line.empty() ? method : asked.line, asked.all_have,
           double(settings.method.solver_limits.max_sweeps), settings.method.h, result.error,
           name_of(result.verdict.state), result.us_per_step.value_or(0), result.us_low, result.us_high,
           double(result.row_updates) / settings.time}};
}

/// Why `run` is refused; empty if it is not.
std::string refusal(const TypedRun& run, const SceneDescription& scene) {
  try {
    scene.build(run.parameters(scene), run.settings(scene).method);
    return "";
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
}

/// The runs that are not refused; tells how many are. Throws std::invalid_argument for a value that no run takes.
std::vector<Asked> possible(const std::vector<Asked>& asked, const SceneDescription& scene) {
  std::vector<Asked> found;
  std::vector<std::pair<Asked, std::string>> refused;
  std::set<std::string> taken;
  for (const Asked& one : asked)
    if (const std::string why = refusal(one.run, scene); why.empty()) {
      found.push_back(one);
      taken.insert(one.values.begin(), one.values.end());
    } else {
      refused.push_back({one, why});
    }
  if (found.empty()) throw std::invalid_argument(refused.front().second);
  std::map<std::string, int> skipped;
  for (const auto& [one, why] : refused) {
    for (const std::string& value : one.values)
      if (!taken.count(value)) throw std::invalid_argument(value + " is refused in every combination: " + why);
    ++skipped[why];
  }
  for (const auto& [why, count] : skipped)
    std::cerr << count << (count == 1 ? " combination" : " combinations") << " skipped: " << why << std::endl;
  return found;
}

/// A scene of the registry, or one from a file. Throws std::invalid_argument if the file has no answer.
SceneDescription chosen_scene(const std::string& name) {
  if (!is_scene_file(name)) return find_scene(name);
  const SceneDescription scene = read_scene(name);
  if (scene.error_unit.empty())
    throw std::invalid_argument(
        name + " has no answer to compare with: add \"expected\", or use ./course run " + name + " --sweep");
  return scene;
}

Experiment experiment(Size size, const Chosen& chosen) {
  const SceneDescription scene = chosen_scene(chosen.scene);
  Experiment e;
  e.timed = true;
  e.columns = {"scene",     "line",           "all have",       "iterations",          "h", "error", "state",
               "us a step", "quartile below", "quartile above", "row updates a second"};
  for (const Asked& asked : possible(all_runs(chosen, scene, size == Size::quick), scene)) {
    const Parameters set = asked.run.parameters(scene);
    const RunSettings settings = asked.run.settings(scene);
    e.points.push_back({key_of(chosen, asked), [=] { return measured(asked, scene, set, settings); }});
  }
  e.check = [scene](const Table& table, Claims& claims) {
    const auto errors = table.numbers("error");
    const auto states = table.texts("state");
    double finite = 1;
    bool any_lost = false;
    for (std::size_t k = 0; k < errors.size(); ++k) {
      const bool lost = states[k] == name_of(State::lost);
      any_lost = any_lost || lost;
      finite = lost || std::isfinite(errors[k]) ? finite : 0;
    }
    claims.at_least(
        any_lost ? "every point that is not lost has a finite error" : "every point has a finite error", finite,
        1);
    const auto updates = table.numbers("row updates a second");
    // The plain engine counts no row updates, and neither does a run that diverges.
    if (scene.name != "stack" || *std::min_element(updates.begin(), updates.end()) == 0) return;
    const auto best = std::min_element(errors.begin(), errors.end()) - errors.begin();
    const auto worst = std::max_element(errors.begin(), errors.end()) - errors.begin();
    claims.at_least(
        "the point with the least error costs at least as many row updates as the point with the largest",
        updates[static_cast<std::size_t>(best)] / updates[static_cast<std::size_t>(worst)], 1);
  };
  return e;
}

}  // namespace
}  // namespace spook::plots

int main(int argc, char** argv) {
  spook::plots::Chosen chosen;
  const auto make = [&](spook::plots::Size size) { return spook::plots::experiment(size, chosen); };
  return spook::plots::run_experiment(argc, argv, make, [&](CLI::App& app) {
    app.add_option("--scene", chosen.scene, "one of ./course scenes, or a file.json");
    app.add_option("--set", chosen.set, "its parameters, NAME=VALUE ...; several values with commas");
    app.add_option("--time", chosen.time, "how long [s]");
    app.add_flag("--warm-start{on}", chosen.warm_start, "begin with the last impulses; =off,on for both");
    for (spook::plots::Option& option : chosen.options)
      app.add_option("--" + option.name, option.values,
                     option.meaning + "; several with commas" +
                         (option.usual.empty() ? "" : "; default: " + option.usual));
  });
}
