#include "spook/print_run.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "scenes/number.hpp"
#include "spook/json.hpp"
#include "spook/text.hpp"

namespace spook {

static std::string parameters_text(const Parameters& parameters) {
  std::string text;
  for (const Parameter& parameter : parameters.all())
    text += (text.empty() ? "" : " ") + parameter.name + "=" + parameter.text();
  return text;
}

static std::string counted(std::int64_t count, const std::string& what) {
  return std::to_string(count) + " " + what + (count == 1 ? "" : "s");
}

/// Tells whether a scene may have friction.
static bool may_rub(const SceneDescription& scene, const Parameters& parameters) {
  const auto is_mu = [](const Parameter& one) { return one.name == "mu"; };
  return scene.from_file || std::any_of(parameters.all().begin(), parameters.all().end(), is_mu);
}

/// Text about the rows and their solution: the friction model, its tangents, the solver and its stop rule.
static std::string solver_text(const SceneDescription& scene, const Parameters& parameters,
                               const Method& method) {
  if (method.integrator_order == 4) return scene.solves ? "none: order four holds joints rigid" : "none";
  if (method.soft_steps) return "soft steps of " + counted(*method.soft_steps, "substep");
  if (!scene.solves) return "none: no constraints";
  if (method.engine == Engine::plain && !method.plain_solver)
    return "at most " + counted(method.solver_limits.max_sweeps, "sweep");
  std::string text;
  if (may_rub(scene, parameters))
    text = "friction " + name_of(friction_model(method)) + ", tangents " +
           (method.sliding_tangents ? "sliding" : "fixed") + "; ";
  text += method.solver + ", at most " +
          counted(method.solver_limits.max_sweeps, find_solver<3>(method.solver).iteration);
  if (method.accuracy) text += " or to " + short_text(*method.accuracy) + " of the right-hand side";
  if (method.solver_limits.tolerance > 0)
    text += " or to " + short_text(method.solver_limits.tolerance) + " m/s";
  return text;
}

static std::string steps_text(const Method& method, const RunResult& result) {
  std::string text = counted(result.steps, "step") + " of " + short_text(method.h) + " s";
  if (method.substeps > 1) text += ", each of " + counted(method.substeps, "substep");
  text += ", " + short_text(static_cast<double>(result.steps) * method.h) + " s";
  if (result.start > 0) text += ", restarted at " + short_text(result.start) + " s";
  if (method.threads > 1) text += " on " + counted(method.threads, "thread");
  if (method.engine == Engine::plain) return text + "; plain engine, exercise " + result.plain_step;
  return method.integrator_order == 4 ? text + "; composed to order four" : text;
}

static std::string last_step_text(const Method& method, const StepReport& last, bool verbose) {
  // A solver with a fallback reason used another method, and so do steps of order four.
  const bool by_solver = last.trouble.empty() && method.integrator_order != 4;
  const std::string what = method.soft_steps ? "sweep"
                           : by_solver       ? find_solver<3>(method.solver).iteration
                                             : "iteration";
  // Stiff links, and steps without rows, take no iterations.
  const std::string after = last.iterations > 0 ? ", after " + counted(last.iterations, what) : "";
  const std::string residual = short_text(last.residual) + " m/s in the last step" + after;
  if (!verbose) return residual;
  return residual + "; " + counted(last.pairs, "pair") + ", " + counted(last.contacts, "contact") + ", " +
         counted(last.impacts, "impact") + ", " + counted(last.rows, "row");
}

/// Prints what the solver of the plain engine reported.
static std::string own_step_text(const StepReport& last) {
  if (last.iterations == 0) return "none: the last step took no iterations";
  return short_text(last.residual) + " m/s in the last step, after " + counted(last.iterations, "iteration");
}

/// Prints the times of the stages that ran, in the order of the step.
static std::string stages_text(const RunResult& result) {
  std::string text;
  for (std::size_t s = 0; s < stage_names.size(); ++s)
    if (result.stages.runs[s] > 0)
      text += (text.empty() ? "" : ", ") + std::string(stage_names[s]) + " " +
              short_text(1e6 * result.stages.seconds[s] / static_cast<double>(result.steps));
  return text + " µs; no other stage ran";
}

/// Prints "x [m]" and 0.5 as "x 0.5 m", for the first few columns, or for all. Names the columns that a plain engine
/// does not report.
static std::string state_text(const RunResult& result, bool all, bool plain) {
  std::string text, unknown;
  std::size_t shown = 0;
  for (std::size_t c = 0; c < result.columns.size(); ++c) {
    const std::string& column = result.columns[c];
    const std::size_t bracket = column.find(" [");
    const std::string name = column.substr(0, bracket);
    if (plain && std::isnan(result.state[c])) {
      unknown += (unknown.empty() ? "; not reported by this engine: " : ", ") + name;
    } else if (all || shown < 4) {
      text += (shown++ > 0 ? ", " : "") + name + ' ' + short_text(result.state[c]);
      if (bracket != std::string::npos) text += ' ' + column.substr(bracket + 2, column.size() - bracket - 3);
    } else {
      return text + ", ... (-v has all)" + unknown;
    }
  }
  return text + unknown;
}

static std::string verdict_text(const Verdict& verdict) {
  if (verdict.state == State::sound) return "sound";
  const std::string where =
      verdict.state == State::lost || verdict.unsolved == 1
          ? "step " + std::to_string(verdict.step)
          : counted(verdict.unsolved, "step") + ", the first " + std::to_string(verdict.step);
  return name_of(verdict.state) + " in " + where + " (" + short_text(verdict.time) + " s): " + verdict.reason;
}

void print_text(std::ostream& out, const SceneDescription& scene, const Parameters& parameters,
                const RunSettings& settings, const RunResult& result, bool verbose) {
  print_entry(out, "scene", scene.name + ": " + scene.summary);
  print_entry(out, "solver", solver_text(scene, parameters, settings.method));
  if (verbose && !parameters.all().empty()) print_entry(out, "set", parameters_text(parameters));
  if (verbose) print_entry(out, "answer", scene.answer);
  print_entry(out, "run", steps_text(settings.method, result));
  print_entry(out, "end", state_text(result, verbose, settings.method.engine == Engine::plain));
  if (scene.error_unit.empty())
    print_entry(out, "error", scene.error_name);
  else if (std::isnan(result.error))
    print_entry(out, "error", "none in this run: " + scene.error_name);
  else
    print_entry(out, "error", short_text(result.error) + " " + scene.error_unit + ": " + scene.error_name);
  print_entry(out, "state", verdict_text(result.verdict));
  if (!result.verdict.note.empty()) print_entry(out, "note", result.verdict.note);
  print_entry(out, "time",
              result.us_per_step ? short_text(*result.us_per_step) + " µs a step" : "no step taken");
  if (settings.method.engine == Engine::plain) {  // its stages and rows are its own
    if (scene.solves) print_entry(out, "residual", own_step_text(result.last));
    return;
  }
  if (verbose && result.us_per_step) print_entry(out, "stages", stages_text(result));
  if (scene.solves) print_entry(out, "residual", last_step_text(settings.method, result.last, verbose));
  if (!result.last.trouble.empty()) print_entry(out, "trouble", result.last.trouble);
}

void print_json(std::ostream& out, const SceneDescription& scene, const Parameters& parameters,
                const RunSettings& settings, const RunResult& result) {
  Json stages = Json::object();
  for (std::size_t s = 0; s < stage_names.size(); ++s)
    stages[stage_names[s]] = result.stages.runs[s] > 0
                                 ? Json(1e6 * result.stages.seconds[s] / static_cast<double>(result.steps))
                                 : Json();

  Json object = {{"program", {{"version", SPOOK_VERSION}, {"compiler", SPOOK_COMPILER}}},
                 {"scene", scene.name},
                 {"parameters", json_of(parameters)}};
  object.update(json_of(settings.method, scene.solves));
  object.update({
      {"steps", result.steps},
      {"time", static_cast<double>(result.steps) * settings.method.h},
      {"us_per_step", result.us_per_step ? Json(*result.us_per_step) : Json()},
      {"us_per_step_of_stage", stages},
      {"row_updates", result.row_updates},
      {"error", {{"name", scene.error_name}, {"value", result.error}, {"unit", scene.error_unit}}},
      {"state",
       {{"name", name_of(result.verdict.state)},
        {"step", result.verdict.step},
        {"time", result.verdict.time},
        {"unsolved_steps", result.verdict.unsolved},
        {"reason", result.verdict.reason},
        {"note", result.verdict.note}}},
      {"residual", scene.solves ? Json(result.last.residual) : Json()},
      {"last_step",
       {{"pairs", result.last.pairs},
        {"contacts", result.last.contacts},
        {"impacts", result.last.impacts},
        {"rows", result.last.rows},
        {"iterations", result.last.iterations},
        {"trouble", result.last.trouble}}},
  });
  out << object.dump() << '\n';
}

}  // namespace spook
