#include "spook/scenes_command.hpp"

#include <cmath>
#include <nlohmann/json.hpp>

#include "scenes/number.hpp"
#include "scenes/registry.hpp"
#include "spook/run_command.hpp"
#include "spook/scene_file.hpp"
#include "spook/text.hpp"

namespace spook {

static Json about(const Parameter& parameter) {
  Json object = {{"name", parameter.name}, {"meaning", parameter.meaning}};
  if (!parameter.choices.empty()) {
    object["default"] = parameter.choice;
    object["choices"] = parameter.choices;
    return object;
  }
  object["default"] = parameter.value;
  object["unit"] = parameter.unit;
  object["limits"] = parameter.limits.text();
  return object;
}

static Json about(const SceneDescription& scene) {
  Json parameters = Json::array();
  for (const Parameter& parameter : scene.parameters) parameters.push_back(about(parameter));
  return {{"name", scene.name},       {"summary", scene.summary},
          {"answer", scene.answer},   {"error", {{"name", scene.error_name}, {"unit", scene.error_unit}}},
          {"parameters", parameters}, {"h", scene.h},
          {"time", scene.time},       {"solves", scene.solves},
          {"solver", scene.solver}};
}

static std::string joined(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : " | ") + name;
  return text;
}

static std::string details(const Parameter& parameter) {
  if (!parameter.choices.empty()) return joined(parameter.choices) + "; " + parameter.meaning;
  const std::string limits = parameter.limits.text();
  return parameter.meaning + (limits.empty() ? "" : "; " + limits);
}

static void print_scene(std::ostream& out, const SceneDescription& scene) {
  out << scene.name << '\n';
  print_entry(out, "", scene.summary, 2);
  print_entry(out, "  answer", scene.answer);
  print_entry(out, "  error", scene.error_name + ", " + scene.error_unit);
  std::string defaults = "--h " + short_text(scene.h) + " --time " + short_text(scene.time);
  if (scene.solves) defaults += " --solver " + scene.solver;
  print_entry(out, "  default", defaults);
  for (const Parameter& parameter : scene.parameters) {
    std::string setting = "    " + parameter.name + "=" + parameter.text();
    if (!parameter.unit.empty()) setting += " " + parameter.unit;
    print_entry(out, setting, details(parameter), 26);
  }
}

/// Prints one entry for each scene.
static void print_names(std::ostream& out, const std::vector<SceneDescription>& scenes) {
  for (const SceneDescription& each : scenes) print_entry(out, each.name, each.summary, 22);
  out << "\nA scene's parameters and its known answer: ./course scenes NAME\n";
}

/// Prints the scene as a file, with its initial state.
static void print_as_file(std::ostream& out, const std::string& scene, const std::vector<std::string>& set) {
  const SceneDescription description = scene_named(scene);
  RunCommand command;
  command.set = set;
  const Method method = command.settings(description).method;
  out << scene_as_file(description, command.parameters(description), method).dump(1) << '\n';
}

void ScenesCommand::execute(std::ostream& out) const {
  if (as_file) {
    if (scene.empty() || json) throw std::invalid_argument("--export needs one scene, without --json");
    return print_as_file(out, scene, set);
  }
  if (!set.empty()) throw std::invalid_argument("--set needs --export");
  const std::vector<SceneDescription> listed = scene.empty() ? scenes() : std::vector{scene_named(scene)};
  if (json) {
    Json all = {{"scenes", Json::array()}, {"solvers", Json::array()}};
    for (const SceneDescription& each : listed) all["scenes"].push_back(about(each));
    for (const auto& each : solvers<3>())
      all["solvers"].push_back({{"name", each.name}, {"summary", each.summary}});
    out << all.dump() << '\n';
    return;
  }
  if (scene.empty())
    print_names(out, listed);
  else
    print_scene(out, listed.front());
  out << "\nsolvers\n";
  for (const auto& each : solvers<3>()) print_entry(out, "  " + each.name, each.summary, 22);
}

}  // namespace spook
