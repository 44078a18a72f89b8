// Speed against error for any scene: a point for each solver, number of sweeps, and step.
//
//   --scene NAME --set name=value ...     a scene and its parameters (a stack of ten spheres)
//   --solver A,B --iterations 10,100 --h 1/60,1/120
//
// The error is the scene's own. The cost is the median of the microseconds a step with its quartiles, and, the same on
// every machine, the row updates of a second.
#include <CLI/CLI.hpp>
#include <limits>
#include <sstream>

#include "machinery/experiment.hpp"
#include "scenes/number.hpp"
#include "scenes/registry.hpp"
#include "scenes/run.hpp"

namespace spook::plots {
namespace {

struct Chosen {
  std::string scene = "stack";
  std::vector<std::string> set = {"bodies=10"};
  std::string solvers, iterations = "10,30,100,300,1000", steps = "1/60,1/120,1/240";
  std::string time;
};

std::vector<std::string> parts(const std::string& list) {
  std::vector<std::string> found;
  std::istringstream text(list);
  for (std::string part; std::getline(text, part, ',');) found.push_back(part);
  return found;
}

Parameters parameters(const SceneDescription& scene, const std::vector<std::string>& set) {
  Parameters result(scene.parameters);
  for (const std::string& text : set) {
    const std::size_t equals = text.find('=');
    if (equals == std::string::npos)
      throw std::invalid_argument("--set wants NAME=VALUE, but got \"" + text + "\"");
    result.set(text.substr(0, equals), text.substr(equals + 1));
  }
  return result;
}

Experiment experiment(Size size, const Chosen& chosen) {
  const SceneDescription& scene = find_scene(chosen.scene);
  const Parameters set = parameters(scene, chosen.set);
  const double time = chosen.time.empty() ? scene.time : parse_number("time", chosen.time);
  const bool quick = size == Size::quick;
  std::vector<std::string> names = parts(chosen.solvers);
  if (names.empty()) names = {solvers<3>().front().name};
  std::vector<std::string> sweeps = scene.solves ? parts(chosen.iterations) : std::vector<std::string>{"1"};
  if (quick) sweeps.resize(std::min<std::size_t>(sweeps.size(), 3));

  Experiment e;
  e.timed = true;
  e.columns = {"scene",          "solver",         "iterations",          "h", "error", "us a step",
               "quartile below", "quartile above", "row updates a second"};
  for (const std::string& solver : names)
    for (const std::string& h_text : parts(chosen.steps))
      for (const std::string& most : sweeps) {
        find_solver<3>(solver);
        const double h = parse_number("h", h_text);
        const int iterations = parse_whole("iterations", most, 1, std::numeric_limits<int>::max());
        e.points.push_back(
            {scene.name + " " + solver + " " + most + " " + h_text, [=]() -> std::vector<Row> {
               const RunSettings settings{
                   .method = {.h = h, .solver = solver, .stop = {.max_sweeps = iterations}}, .time = time};
               const RunResult result = run(scene, set, settings);
               return {{scene.name, solver, double(iterations), h, result.error, result.us_per_step.value_or(0),
                        result.us_low, result.us_high, double(result.row_updates) / time}};
             }});
      }
  e.check = [scene](const Table& table, Claims& claims) {
    const auto errors = table.numbers("error");
    double finite = 1;
    for (const double error : errors) finite = std::isfinite(error) ? finite : 0;
    claims.at_least("every point has an error that is a number", finite, 1);
    if (scene.name != "stack") return;
    const auto updates = table.numbers("row updates a second");
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
    app.add_option("--scene", chosen.scene, "one of ./course scenes");
    app.add_option("--set", chosen.set, "its parameters, NAME=VALUE ...");
    app.add_option("--solver", chosen.solvers, "solvers, with commas");
    app.add_option("--iterations", chosen.iterations, "most sweeps in a step, with commas");
    app.add_option("--h", chosen.steps, "steps [s], with commas");
    app.add_option("--time", chosen.time, "how long [s]");
  });
}
