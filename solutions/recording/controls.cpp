#include "recording/controls.hpp"

#include <algorithm>

namespace spook {

static Json slider(const std::string& name, double value, const std::string& unit, double low, double high,
                   bool logarithmic) {
  return {{"name", name}, {"value", value}, {"unit", unit},
          {"low", low},   {"high", high},   {"logarithmic", logarithmic}};
}

static Json choice(const std::string& name, const std::string& value, const std::vector<std::string>& choices) {
  return {{"name", name}, {"value", value}, {"choices", choices}};
}

/// A factor of 30 to both sides, or from zero to one or two, as far as the parameter may go.
static Json control(const Parameter& parameter) {
  if (!parameter.choices.empty()) return choice(parameter.name, parameter.choice, parameter.choices);
  const double value = parameter.value, size = std::max(1.0, 2 * std::abs(value));
  const bool logarithmic = value > 0 && !(parameter.limits.high <= 1);
  double low = logarithmic ? value / 30 : parameter.limits.low >= 0 ? 0 : -size;
  double high = logarithmic ? value * 30 : size;
  if (parameter.limits.whole) low = std::max(1.0, std::ceil(low)), high = std::ceil(high);
  return slider(parameter.name, value, parameter.unit, std::max(low, parameter.limits.low),
                std::min(high, parameter.limits.high), logarithmic);
}

static std::vector<std::string> solver_names() {
  std::vector<std::string> names;
  for (const NamedSolver<3>& solver : solvers<3>()) names.push_back(solver.name);
  return names;
}

Json controls(const SceneDescription& description, const Parameters& parameters, const Method& method) {
  Json list = {slider("h", method.h, "s", description.h / 30, description.h * 10, true)};
  if (description.solves) {
    list.push_back(choice("solver", method.solver, solver_names()));
    list.push_back(slider("iterations", method.stop.max_sweeps, "", 1, 1000, true));
    list.push_back(choice("friction_model", name_of(method.friction_model), {"box", "two_pass", "cone"}));
    list.push_back(choice("warm_start", method.warm_start ? "on" : "off", {"off", "on"}));
  }
  for (const Parameter& parameter : parameters.all()) list.push_back(control(parameter));
  return list;
}

}  // namespace spook
