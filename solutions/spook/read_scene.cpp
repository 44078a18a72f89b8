// Scenes from files: builds a new world for each run, and compares it with the answer in the file.
#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <memory>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include "engine/support/did_you_mean.hpp"
#include "scenes/number.hpp"
#include "scenes/registry.hpp"
#include "spook/file_parameters.hpp"
#include "spook/file_world.hpp"
#include "spook/scene_file.hpp"

namespace spook {

namespace {

/// The right position of a body at a time.
struct Expected {
  int body;
  double time;  ///< [s]
  Vec3 x;       ///< [m]
  double tolerance;
  double error = std::numeric_limits<double>::quiet_NaN();  ///< in tolerances; NaN before its time
};

/// Throws std::invalid_argument for a time that lies before the start or between two steps.
void require_at_a_step(const Place& time, double h) {
  const double steps = time.number() / h;
  if (!(h > 0)) return;  // the run refuses such a step
  if (steps >= 0 && std::abs(steps - std::round(steps)) <= 1e-6 * std::max(1.0, steps)) return;
  time.reject("a whole number of steps of " + short_text(h) + " s");
}

template <int Dof>
class FileScene : public WorldScene<Dof> {
 public:
  FileScene(const Json& json, const Method& method) : WorldScene<Dof>(settings_in<Dof>({json, ""}), method) {
    const Place file(json, "");
    const BodyNames names(file["bodies"]);
    add_all(file, names, this->world_);
    if (const auto start = file.find("half_step_start"); start && start->flag()) {
      // Joints change velocities from the first half step on: without their forces the start is of first order.
      if (this->world_.joints().empty())
        this->world_.start_half_step_back(this->h_);
      else
        this->world_.start_consistently(this->h_);
    }
    if (const auto expected = file.find("expected"))
      for (const Place& each : expected->list()) {
        each.require_keys({"body", "time", "x", "tolerance"});
        expected_.push_back(
            {names.index(each["body"]), each["time"].number(), each["x"].vector(), each["tolerance"].number()});
        if (!(expected_.back().tolerance > 0)) each["tolerance"].reject("positive");
        require_at_a_step(each["time"], this->h_);
      }
  }

  void observe() override {
    for (Expected& each : expected_)
      if (std::abs(each.time - this->time()) <= this->h_ / 2)
        each.error = (this->world_.x(each.body) - each.x).norm() / each.tolerance;
  }
  double error() const override {
    if (expected_.empty()) return std::numeric_limits<double>::quiet_NaN();
    double error = 0;
    for (const Expected& each : expected_) error = larger(error, each.error);
    return error;
  }

  void results(StateStream& s) override {
    for (Expected& each : expected_) s(each.error);
  }

  std::vector<std::string> columns() const override {
    std::vector<std::string> names = {"time [s]"};
    for (std::size_t i = 0; i < this->world_.bodies().size(); ++i)
      if (!this->world_.bodies().is_fixed(i))
        for (const char* axis : {"x", "y", "z"})
          names.push_back(std::string(axis) + " of body " + std::to_string(i) + " [m]");
    return names;
  }
  std::vector<double> sample() const override {
    std::vector<double> values = {this->time()};
    for (std::size_t i = 0; i < this->world_.bodies().size(); ++i)
      if (!this->world_.bodies().is_fixed(i))
        for (const double number : this->world_.bodies().x[i]) values.push_back(number);
    return values;
  }

 private:
  std::vector<Expected> expected_;
};

/// Levels of lists and objects. A scene has five; what copies or prints JSON calls itself for each.
constexpr int deepest = 20;

Json parsed(const std::string& file) {
  std::ifstream in(file);
  if (!in) throw std::invalid_argument("the file cannot be read");
  std::vector<std::set<std::string>> keys;  // of the objects around the present place
  try {
    return Json::parse(in, [&keys](int depth, Json::parse_event_t event, Json& value) {
      if (depth > deepest) {
        throw std::invalid_argument("lists and objects lie more than " + std::to_string(deepest) +
                                    " deep in one another");
      }
      if (event == Json::parse_event_t::object_start) keys.emplace_back();
      if (event == Json::parse_event_t::object_end) keys.pop_back();
      // JSON would keep the last value, and drop the others.
      if (event == Json::parse_event_t::key && !keys.back().insert(value.get<std::string>()).second)
        throw std::invalid_argument("\"" + value.get<std::string>() + "\" is given twice in one object");
      return true;
    });
  } catch (const Json::exception& error) {
    // "[json.exception.parse_error.101] parse error at line 1, column 2: ..."
    const std::string what = error.what();
    const std::size_t where = what.find("line "), said = what.find("] ");
    throw std::invalid_argument(where != std::string::npos  ? what.substr(where)
                                : said != std::string::npos ? what.substr(said + 2)
                                                            : what);
  }
}

SceneDescription described(const std::string& name, const Json& written) {
  Place(written, "")
      .require_keys({"format", "version", "summary", "model", "h", "time", "solver", "half_step_start",
                     "parameters", "settings", "bodies", "joints", "materials", "no_contact", "expected"});
  // Options of a run change these, as they do for a scene without a file.
  const auto require_number = [](const std::optional<Place>& place, const std::string& option) {
    if (place && place->holds_text() && place->text().starts_with("$"))
      place->reject("a number, which --" + option + " changes");
  };
  for (const std::string key : {"h", "time"}) require_number(Place(written, "").find(key), key);
  if (const auto settings = Place(written, "").find("settings"))
    for (const std::string key : {"integrator_order", "compose"})
      require_number(settings->find(key), "integrator-order");
  const std::vector<Parameter> parameters = parameters_in(written);
  const Json json = with_values(written, parameters);
  const Place file(json, "");
  if (file["format"].text() != "spook scene") file["format"].reject("\"spook scene\"");
  const int version = file["version"].whole();
  if (version != 1 && version != 2) file["version"].reject("1 or 2");
  const bool points = one_of<bool>(file["model"], {{"point", true}, {"rigid", false}});
  const bool answered = file.has("expected");
  SceneDescription scene{
      .name = name,
      .summary = file.has("summary") ? file["summary"].text() : "A scene of a file.",
      .answer =
          answered ? "Positions of bodies at certain times, as given in the file." : "None: the file has none.",
      .error_name = answered ? "largest distance from where a body should be" : "no answer to compare with",
      .error_unit = answered ? "tolerances" : "",
      .parameters = parameters,
      .h = file["h"].number(),
      .time = file["time"].number(),
      .solves = true,
      .build = [written, points](const Parameters& set, const Method& method) -> std::unique_ptr<Scene> {
        const Json valued = with_values(written, set.all());
        if (points) return std::make_unique<FileScene<3>>(valued, method);
        return std::make_unique<FileScene<6>>(valued, method);
      }};
  scene.from_file = true;
  scene.solver = file.has("solver") ? file["solver"].text() : "auto";
  const std::string present = present_name(scene.solver);
  if (version == 1 && !present.empty()) scene.solver = present;
  if (const auto settings = file.find("settings")) {
    if (const auto model = settings->find("friction_model"))
      scene = with_friction(one_of<FrictionModel>(*model, {{"box", FrictionModel::box},
                                                           {"two_pass", FrictionModel::two_pass},
                                                           {"cone", FrictionModel::cone}}),
                            std::move(scene));
    if (const auto order = settings->find(version == 1 ? "compose" : "integrator_order"))
      scene.integrator_order = order->whole();
  }
  return scene;
}

}  // namespace

bool is_scene_file(const std::string& name) {
  return name.size() > 5 && name.compare(name.size() - 5, 5, ".json") == 0;
}

SceneDescription read_scene(const std::string& file) {
  const auto told = [&file](const auto& action) {
    try {
      return action();
    } catch (const std::invalid_argument& error) {
      throw std::invalid_argument(file + ": " + error.what());
    }
  };
  const std::size_t slash = file.find_last_of('/') + 1;  // 0 without one
  SceneDescription scene =
      told([&] { return described(file.substr(slash, file.size() - 5 - slash), parsed(file)); });
  told([&] { return scene.build(Parameters(scene.parameters), {.h = scene.h, .solver = scene.solver}); });
  return scene;
}

SceneDescription scene_named(const std::string& name) {
  return is_scene_file(name) ? read_scene(name) : find_scene(name);
}

}  // namespace spook
