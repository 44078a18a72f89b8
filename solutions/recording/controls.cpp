#include "recording/controls.hpp"

#include <algorithm>

namespace spook {

struct Range {
  double low, high;
  bool logarithmic, whole;
};

/// Begins a control; `meaning` is shown beside its name.
static Json control_of(const std::string& name, const std::string& meaning) {
  return {{"name", name}, {"meaning", meaning}};
}

static Json slider(Json control, double value, const std::string& unit, const Range& range) {
  control.update({{"value", value},
                  {"unit", unit},
                  {"low", range.low},
                  {"high", range.high},
                  {"logarithmic", range.logarithmic},
                  {"whole", range.whole}});
  return control;
}

static Json choice(Json control, const std::string& value, const std::vector<std::string>& choices) {
  control.update({{"value", value}, {"choices", choices}});
  return control;
}

/// Returns a range of a factor of 30 in both directions, or from zero to one or two. An angle has the whole circle, and
/// a ratio, which is at least 1, six decades.
static Range wide_range(const Parameter& parameter) {
  const double value = parameter.value, size = std::max(1.0, 2 * std::abs(value));
  const Limits& limits = parameter.limits;
  if (parameter.unit == "degrees") return {-180, 180, false, false};
  if (limits.low == 1 && !limits.whole) return {1, std::max(1e6, value), true, false};
  if (value > 0 && !(limits.high <= 1)) return {value / 30, value * 30, true, limits.whole};
  return {limits.low >= 0 ? 0 : -size, size, false, limits.whole};
}

/// Returns a control with values within the parameter's limits.
static Json control(const Parameter& parameter) {
  const Json begun = control_of(parameter.name, parameter.meaning);
  if (!parameter.choices.empty()) return choice(begun, parameter.choice, parameter.choices);
  Range range = wide_range(parameter);
  const Limits& limits = parameter.limits;
  if (limits.whole) range.low = std::max(1.0, std::ceil(range.low));
  if (limits.whole) range.high = std::ceil(range.high);
  const double open =
      range.logarithmic ? 0 : 1e-3 * (range.high - range.low);  // kept from a limit not included
  range.low = std::max(range.low, limits.low_included ? limits.low : limits.low + open);
  range.high = std::min(range.high, limits.high_included ? limits.high : limits.high - open);
  return slider(begun, parameter.value, parameter.unit, range);
}

static std::vector<std::string> solver_names() {
  std::vector<std::string> names;
  for (const NamedSolver<3>& solver : solvers<3>()) names.push_back(solver.name);
  return names;
}

Json controls(const SceneDescription& description, const Parameters& parameters, const Method& method) {
  Json list = Json::array();
  list.push_back(slider(control_of("h", "time step"), method.h, "s",
                        {description.h / 30, description.h * 10, true, false}));
  if (description.solves) {
    list.push_back(
        choice(control_of("solver", "of the step's constraint rows"), method.solver, solver_names()));
    list.push_back(slider(control_of("iterations", "largest number of sweeps in a step"),
                          method.solver_limits.max_sweeps, "", {1, 1000, true, true}));
    list.push_back(choice(control_of("friction_model", "limits of the friction impulse"),
                          name_of(friction_model(method)), {"box", "two_pass", "cone"}));
    list.push_back(
        choice(control_of("row_order", "in which a sweep takes the rows; any but given needs gauss_seidel"),
               name_of(method.row_order), row_orders()));
    list.push_back(choice(control_of("warm_start", "sweeps begin with the last step's impulses"),
                          method.warm_start ? "on" : "off", {"off", "on"}));
  }
  for (const Parameter& parameter : parameters.all()) list.push_back(control(parameter));
  return list;
}

}  // namespace spook
