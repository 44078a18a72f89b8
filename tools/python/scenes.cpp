// Scenes and their runs, with the options of `spook run`: each option is text, as typed, and is refused with the same
// message. The package's Python code turns the results into objects.
#include <pybind11/eigen.h>
#include <pybind11/stl.h>

#include <sstream>

#include "engine/support/did_you_mean.hpp"
#include "module.hpp"
#include "recording/recorder.hpp"
#include "scenes/registry.hpp"
#include "scenes/run.hpp"
#include "spook/run_command.hpp"
#include "spook/scene_file.hpp"

namespace spook {

namespace {

using namespace py::literals;
using Texts = std::map<std::string, std::string>;

/// The options as typed. Throws std::invalid_argument for an unknown option.
RunCommand command_of(const std::string& scene, const Texts& parameters, const Texts& options) {
  RunCommand command;
  command.scene = scene;
  for (const auto& [name, value] : parameters) command.set.push_back(name + "=" + value);
  const std::vector<std::pair<std::string, std::optional<std::string>*>> known = {
      {"h", &command.h},
      {"time", &command.time},
      {"solver", &command.solver},
      {"iterations", &command.iterations},
      {"tolerance", &command.tolerance},
      {"accuracy", &command.accuracy},
      {"substeps", &command.substeps},
      {"integrator_order", &command.integrator_order},
      {"row_order", &command.row_order},
      {"seed", &command.seed},
      {"contact_margin", &command.contact_margin},
      {"max_parts", &command.max_parts},
      {"friction_model", &command.friction_model},
      {"tangents", &command.tangents},
      {"soft_steps", &command.soft_steps},
      {"threads", &command.threads}};
  for (const auto& [name, value] : options) {
    std::vector<std::string> names = {"warm_start"};
    bool found = name == "warm_start";
    for (const auto& [option, typed] : known) {
      names.push_back(option);
      if (option == name) *typed = value, found = true;
    }
    if (!found) throw std::invalid_argument("unknown option \"" + name + "\"" + did_you_mean(name, names));
    if (name == "warm_start") command.retype(name, value);
  }
  return command;
}

py::dict describe(const std::string& name) {
  const SceneDescription scene = scene_named(name);
  py::dict parameters;
  for (const Parameter& parameter : scene.parameters)
    parameters[parameter.name.c_str()] =
        py::dict("meaning"_a = parameter.meaning, "unit"_a = parameter.unit, "default"_a = parameter.text(),
                 "choices"_a = parameter.choices);
  return py::dict("name"_a = scene.name, "summary"_a = scene.summary, "answer"_a = scene.answer,
                  "error_name"_a = scene.error_name, "error_unit"_a = scene.error_unit, "h"_a = scene.h,
                  "time"_a = scene.time, "solver"_a = scene.solver, "parameters"_a = parameters);
}

/// Refuses invalid options as a run would, without a step.
void check(const std::string& name, const Texts& set, const Texts& options) {
  const SceneDescription scene = scene_named(name);
  const RunCommand command = command_of(name, set, options);
  scene.build(command.parameters(scene), command.settings(scene).method);
}

/// The sample of each step, a row each.
using Samples = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

Samples as_rows(const std::vector<double>& numbers, std::size_t columns) {
  return Eigen::Map<const Samples>(numbers.data(), static_cast<Eigen::Index>(numbers.size() / columns),
                                   static_cast<Eigen::Index>(columns));
}

py::dict run_scene(const std::string& name, const Texts& set, const Texts& options) {
  const SceneDescription scene = scene_named(name);
  const RunCommand command = command_of(name, set, options);
  const Parameters parameters = command.parameters(scene);
  const RunSettings settings = command.settings(scene);
  std::vector<double> samples;
  Watch watch;
  watch.look = [&](Scene& now, std::int64_t) {
    const std::vector<double> sample = now.sample();
    samples.insert(samples.end(), sample.begin(), sample.end());
    if (scene.solves) samples.push_back(now.report().residual);
  };
  RunResult result;
  {
    const py::gil_scoped_release others_may_run;
    result = run(scene, parameters, settings, watch);
  }
  if (scene.solves) result.columns.push_back("residual [m/s]");
  return py::dict("error"_a = result.error, "state"_a = name_of(result.verdict.state),
                  "reason"_a = result.verdict.reason, "note"_a = result.verdict.note,
                  "unsolved_steps"_a = result.verdict.unsolved, "us_per_step"_a = result.us_per_step,
                  "residual"_a = result.last.residual, "row_updates"_a = result.row_updates,
                  "h"_a = settings.method.h, "steps"_a = result.steps, "solver"_a = settings.method.solver,
                  "columns"_a = result.columns, "samples"_a = as_rows(samples, result.columns.size()));
}

/// The output of `spook run --record`; if a run blows up, its output until then.
py::bytes record(const std::string& name, const Texts& set, const Texts& options, double fps) {
  const SceneDescription scene = scene_named(name);
  const RunCommand command = command_of(name, set, options);
  const Parameters parameters = command.parameters(scene);
  const RunSettings settings = command.settings(scene);
  steps_of_frame(settings.method.h, fps);
  std::ostringstream out;
  {
    const py::gil_scoped_release others_may_run;
    Recorder recorder(out, scene, parameters, settings, fps);
    const std::unique_ptr<Scene> running = scene.build(parameters, settings.method);
    const std::int64_t substeps = step_count(settings.method.h, settings.time) * settings.method.substeps;
    std::string why;
    try {
      for (std::int64_t n = 0; n <= substeps; ++n) {
        if (n > 0) running->advance(1);
        running->observe();
        running->judge();
        recorder.look(*running, n);
      }
    } catch (const SimulationDiverged& blowup) {
      why = blowup.what();
    }
    recorder.end(why);
  }
  return out.str();
}

}  // namespace

void bind_scenes(py::module_& module) {
  module.def(
      "scenes",
      [] {
        std::vector<std::string> names;
        for (const SceneDescription& scene : scenes()) names.push_back(scene.name);
        return names;
      },
      docstring("scenes"));
  module.def(
      "solvers",
      [] {
        std::vector<std::string> names;
        for (const auto& solver : solvers<3>()) names.push_back(solver.name);
        return names;
      },
      docstring("solvers"));
  module.def("describe", &describe, "scene"_a);
  module.def("check", &check, "scene"_a, "parameters"_a, "options"_a);
  module.def("run", &run_scene, "scene"_a, "parameters"_a, "options"_a);
  module.def("record", &record, "scene"_a, "parameters"_a, "options"_a, "fps"_a);
}

}  // namespace spook

PYBIND11_MODULE(_spook, module) {
  module.attr("__version__") = SPOOK_VERSION;
#ifdef __clang__
  module.attr("__compiler__") = "clang " __clang_version__;
#else
  module.attr("__compiler__") = "GCC " __VERSION__;
#endif
  spook::py::register_exception<spook::SimulationDiverged>(module, "SimulationDiverged", PyExc_RuntimeError);
  spook::bind_worlds(module);
  spook::bind_scenes(module);
}
