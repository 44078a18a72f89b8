#include "spook/json.hpp"

namespace spook {

const std::vector<std::string>& row_orders() {
  static const std::vector<std::string> names = {"given", "up", "down", "random", "interleaved"};
  return names;
}

const std::string& name_of(RowOrder order) {
  return row_orders()[static_cast<std::size_t>(order)];
}

Json numbers(const Vec3& v) {
  return {v.x(), v.y(), v.z()};
}

Json json_of(const Parameter& parameter) {
  if (!parameter.choices.empty()) return parameter.choice;
  if (parameter.limits.whole) return static_cast<std::int64_t>(parameter.value);
  return parameter.value;
}

Json json_of(const Parameters& parameters) {
  Json set = Json::object();
  for (const Parameter& parameter : parameters.all()) set[parameter.name] = json_of(parameter);
  return set;
}

Json json_of(const Method& method, bool solves) {
  // Soft steps have sweeps of their own, and steps of order four hold joints rigid.
  const bool has_solver = solves && !method.soft_steps && method.integrator_order != 4;
  const auto of_rows = [&](const Json& value) { return has_solver ? value : Json(); };
  return {
      {"solver", has_solver ? method.solver : "none"},
      {"iterations", of_rows(method.solver_limits.max_sweeps)},
      {"tolerance", of_rows(method.solver_limits.tolerance)},
      {"accuracy", method.accuracy ? of_rows(*method.accuracy) : Json()},
      {"row_order", of_rows(name_of(method.row_order))},
      {"warm_start", of_rows(method.warm_start)},
      {"max_parts", method.max_parts ? Json(*method.max_parts) : Json()},
      {"contact_margin", method.contact_margin ? of_rows(*method.contact_margin) : Json()},
      {"friction_model", solves ? Json(name_of(friction_model(method))) : Json()},
      {"tangents", solves ? Json(method.sliding_tangents ? "sliding" : "fixed") : Json()},
      {"h", method.h},
      {"substeps", method.substeps},
      {"integrator_order", method.integrator_order.value_or(2)},
      {"threads", method.threads},
      {"soft_steps", method.soft_steps ? Json(*method.soft_steps) : Json()},
      {"engine", method.engine == Engine::plain ? "plain" : "fast"},
  };
}

}  // namespace spook
