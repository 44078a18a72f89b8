#include "scenes/typed_run.hpp"

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <utility>
#include <vector>

#include "engine/support/parallel_for.hpp"
#include "scenes/choose.hpp"
#include "scenes/number.hpp"

namespace spook {

static void assign(Parameters& parameters, const std::string& text) {
  const std::size_t equals = text.find('=');
  if (equals == 0 || equals == std::string::npos)
    throw std::invalid_argument("--set must be NAME=VALUE, but is \"" + text + "\"");
  const std::string name = text.substr(0, equals);
  if (name == "h" || name == "time")
    throw std::invalid_argument(name + " is not a parameter of a scene: use --" + name + " " +
                                text.substr(equals + 1));
  parameters.set(name, text.substr(equals + 1));
}

/// Reads the options of rows and sweeps.
static void set_rows(const TypedRun& typed, Method& method) {
  if (typed.row_order)
    method.row_order = choose<RowOrder>("row-order", *typed.row_order,
                                        {{"given", RowOrder::given},
                                         {"up", RowOrder::up},
                                         {"down", RowOrder::down},
                                         {"random", RowOrder::random},
                                         {"interleaved", RowOrder::interleaved}});
  if (typed.seed)
    method.seed =
        static_cast<std::uint64_t>(parse_whole("seed", *typed.seed, 0, std::numeric_limits<int>::max()));
  method.warm_start = typed.warm_start;
  if (typed.contact_margin) method.contact_margin = parse_number("contact-margin", *typed.contact_margin);
  if (method.contact_margin && *method.contact_margin < 0)
    throw std::invalid_argument("contact-margin must be at least 0, but is " + *typed.contact_margin);
  if (typed.friction_model) method.friction_model = find_friction_model(*typed.friction_model);
  if (typed.tangents)
    method.sliding_tangents = choose<bool>("tangents", *typed.tangents, {{"fixed", false}, {"sliding", true}});
}

/// An option, and whether it is given.
using Option = std::pair<const char*, bool>;

/// Throws std::invalid_argument for the first option that is given; `why` goes on after its name.
static void refuse_given(const std::vector<Option>& options, const std::string& why) {
  for (const auto& [option, given] : options)
    if (given) throw std::invalid_argument(std::string(option) + " " + why);
}

/// Rejects options that have no effect in steps of order four, which have their own method for joints.
static void refuse_beside_composed(const TypedRun& typed) {
  refuse_given({{"solver", typed.solver.has_value()},
                {"row-order", typed.row_order.has_value()},
                {"friction-model", typed.friction_model.has_value()},
                {"tangents", typed.tangents.has_value()},
                {"max-parts", typed.max_parts.has_value()},
                {"accuracy", typed.accuracy.has_value()},
                {"warm-start", typed.warm_start}},
               "has no effect with integrator-order 4, whose joints are rigid: leave it out");
}

/// Rejects options that have no effect in soft steps, whose sweeps are their own.
static void refuse_beside_soft(const TypedRun& typed) {
  refuse_given({{"solver", typed.solver.has_value()},
                {"iterations", typed.iterations.has_value()},
                {"tolerance", typed.tolerance.has_value()},
                {"row-order", typed.row_order.has_value()},
                {"friction-model", typed.friction_model.has_value()},
                {"integrator-order", typed.integrator_order.has_value()},
                {"max-parts", typed.max_parts.has_value()},
                {"warm-start", typed.warm_start}},
               "has no effect with soft-steps: leave it out");
}

/// Rejects options that choose another solver.
static void refuse_beside_accuracy(const TypedRun& typed) {
  refuse_given({{"row-order", typed.row_order.has_value()},
                {"soft-steps", typed.soft_steps.has_value()},
                {"integrator-order", typed.integrator_order.has_value()}},
               "has no effect with accuracy, which is that of the solver auto: leave one of them out");
}

/// Refuses options that no step of the plain engine has.
static void refuse_beside_plain(const TypedRun& typed) {
  refuse_given({{"contact-margin", typed.contact_margin.has_value()},
                {"tangents", typed.tangents.has_value()},
                {"max-parts", typed.max_parts.has_value()},
                {"threads", typed.threads.has_value()},
                {"accuracy", typed.accuracy.has_value()},
                {"soft-steps", typed.soft_steps.has_value()}},
               "needs the fast engine: leave it out, or use --engine fast");
}

/// Refuses a seed where no rows are in a random order. A scene with random bodies has a seed of its own.
static void require_random_order(const TypedRun& typed, const SceneDescription& description, RowOrder order) {
  if (!typed.seed || order == RowOrder::random) return;
  const std::vector<Parameter>& of_scene = description.parameters;
  const bool has_own =
      std::any_of(of_scene.begin(), of_scene.end(), [](const Parameter& p) { return p.name == "seed"; });
  throw std::invalid_argument(
      "seed has no effect without row-order random: " +
      (has_own ? "for the scene's own, use --set seed=" + *typed.seed : "leave it out"));
}

/// Refuses a list in the place of a number.
static void refuse_lists(const TypedRun& typed) {
  const std::vector<std::pair<std::string, std::optional<std::string>>> numbers = {
      {"h", typed.h},
      {"time", typed.time},
      {"iterations", typed.iterations},
      {"tolerance", typed.tolerance},
      {"accuracy", typed.accuracy},
      {"substeps", typed.substeps},
      {"integrator-order", typed.integrator_order},
      {"seed", typed.seed},
      {"contact-margin", typed.contact_margin},
      {"max-parts", typed.max_parts},
      {"threads", typed.threads},
      {"soft-steps", typed.soft_steps}};
  for (const auto& [name, text] : numbers)
    if (text && text->find(',') != std::string::npos)
      throw std::invalid_argument(name + " must be one number, but is \"" + *text + "\": a sweep of " + name +
                                  " takes a list");
}

Parameters TypedRun::parameters(const SceneDescription& description) const {
  Parameters parameters(description.parameters);
  for (const std::string& text : set) assign(parameters, text);
  return parameters;
}

RunSettings TypedRun::settings(const SceneDescription& description) const {
  RunSettings settings{.method = {.h = description.h,
                                  .solver = description.solver,
                                  .friction_model = description.friction_model,
                                  .integrator_order = description.integrator_order},
                       .time = description.time};
  Method& method = settings.method;
  refuse_lists(*this);
  if (h) method.h = parse_number("h", *h);
  if (time) settings.time = parse_number("time", *time);
  if (solver) method.solver = *solver;
  if (iterations)
    method.solver_limits.max_sweeps =
        parse_whole("iterations", *iterations, 1, std::numeric_limits<int>::max());
  if (tolerance) {
    method.solver_limits.tolerance = parse_number("tolerance", *tolerance);
    if (method.solver_limits.tolerance < 0)
      throw std::invalid_argument("tolerance must be at least 0, but is " + *tolerance);
  }
  if (substeps) method.substeps = parse_whole("substeps", *substeps, 1, 1'000'000);
  if (max_parts) method.max_parts = parse_whole("max-parts", *max_parts, 1, 1024);
  if (threads) method.threads = parse_whole("threads", *threads, 1, most_threads);
  if (integrator_order)
    method.integrator_order = choose<int>("integrator-order", *integrator_order, {{"2", 2}, {"4", 4}});
  if (engine)
    method.engine = choose<Engine>("engine", *engine, {{"fast", Engine::fast}, {"plain", Engine::plain}});
  if (method.engine == Engine::plain) {
    refuse_beside_plain(*this);
    method.plain_solver = solver || friction_model || row_order || warm_start;
  }
  if (accuracy) {
    refuse_beside_accuracy(*this);
    method.accuracy = parse_number("accuracy", *accuracy);
    if (!solver && !find_solver<3>(method.solver).make_to) method.solver = "auto";
  }
  if (soft_steps) {
    refuse_beside_soft(*this);
    method.soft_steps = parse_whole("soft-steps", *soft_steps, 1, 1024);
  }
  set_rows(*this, method);
  require_random_order(*this, description, method.row_order);
  if (method.integrator_order == 4) refuse_beside_composed(*this);
  // A row order, or the cone, replaces the scene's solver if that solver does not support it.
  if (!solver && method.row_order != RowOrder::given) method.solver = solvers<3>().front().name;
  if (!solver && method.friction_model == FrictionModel::cone && !find_solver<3>(method.solver).make_on_cones)
    method.solver = "auto";
  if (!method.soft_steps) make_solver<3>(method);
  step_count(method.h, settings.time);
  return settings;
}

void TypedRun::retype(const std::string& name, const std::string& value) {
  const std::vector<std::pair<std::string, std::optional<std::string>*>> options = {
      {"h", &h},
      {"solver", &solver},
      {"iterations", &iterations},
      {"friction_model", &friction_model},
      {"row_order", &row_order}};
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

}  // namespace spook
