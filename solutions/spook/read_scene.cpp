// A world from a file, built anew for each run, and the answer that the file carries.
#include <fstream>
#include <map>
#include <memory>
#include <stdexcept>

#include "scenes/registry.hpp"
#include "spook/place.hpp"
#include "spook/scene_file.hpp"

namespace spook {

namespace {

template <class Value>
Value one_of(const Place& place, const std::map<std::string, Value>& choices) {
  const auto found = choices.find(place.text());
  if (found != choices.end()) return found->second;
  std::string names;
  for (const auto& [name, value] : choices) names += (names.empty() ? "" : " or ") + name;
  place.reject(names);
}

void read(const std::optional<Place>& place, double& number) {
  if (place) number = place->number();
}
void read(const std::optional<Place>& place, Vec3& v) {
  if (place) v = place->vector();
}
void read(const std::optional<Place>& place, std::optional<double>& number) {
  if (place) number = place->number();
}

template <int Dof>
Settings<Dof> settings_in(const Place& file) {
  Settings<Dof> settings;
  const std::optional<Place> place = file.find("settings");
  if (!place) return settings;
  place->require_keys(
      {"gravity", "k", "d", "friction", "viscosity", "impacts", "rotation", "gyroscopic_torque"});
  read(place->find("gravity"), settings.gravity);
  read(place->find("k"), settings.k);
  read(place->find("d"), settings.d);
  read(place->find("friction"), settings.friction);
  read(place->find("viscosity"), settings.viscosity);
  if (const auto impacts = place->find("impacts")) {
    impacts->require_keys({"restitution", "friction", "threshold", "max_passes"});
    ImpactLaw law;
    read(impacts->find("restitution"), law.restitution);
    read(impacts->find("friction"), law.friction);
    read(impacts->find("threshold"), law.threshold);
    if (const auto passes = impacts->find("max_passes")) law.max_passes = passes->whole();
    settings.impacts = law;
  }
  if constexpr (Dof == 6) {
    if (const auto update = place->find("rotation"))
      settings.rotation.update =
          one_of<RotationUpdate>(*update, {{"splitting", RotationUpdate::splitting},
                                           {"first_order", RotationUpdate::first_order},
                                           {"exponential", RotationUpdate::exponential}});
    if (const auto torque = place->find("gyroscopic_torque"))
      settings.rotation.gyroscopic_torque = torque->flag();
  }
  return settings;
}

/// Does something with a place; what the engine refuses is told with it: bodies[3].mass must be ...
template <class Action>
void at(const Place& place, const Action& action) {
  try {
    action();
  } catch (const std::invalid_argument& error) {
    const std::string what = error.what();
    if (what.rfind(place.path(), 0) == 0) throw;
    const bool names_key = place.has(what.substr(0, what.find(' ')));
    throw std::invalid_argument(place.path() + (names_key ? "." : ": ") + what);
  }
}

double volume(const Place& place, double radius, const Vec3& half_sides) {
  if (radius > 0) return 4.0 / 3 * std::acos(-1) * radius * radius * radius;
  if (!half_sides.isZero(0)) return 8 * half_sides.prod();
  place.reject("left out for what is no sphere and no box");
}

template <int Dof>
void add_moving(const Place& place, World<Dof>& world) {
  Body<Dof> body;
  read(place.find("x"), body.x);
  read(place.find("v"), body.v);
  read(place.find("radius"), body.radius);
  Vec3 half_sides = Vec3::Zero();
  if constexpr (Dof == 3) {
    place.require_keys({"name", "x", "v", "mass", "density", "radius"});
  } else {
    place.require_keys(
        {"name", "x", "v", "mass", "density", "radius", "q", "omega", "principal", "half_sides", "corners"});
    if (const auto q = place.find("q")) body.q = q->quaternion();
    read(place.find("omega"), body.omega);
    if (const auto moments = place.find("principal")) body.principal = moments->vector();
    read(place.find("half_sides"), body.half_sides);
    if (const auto corners = place.find("corners"))
      for (const Place& corner : corners->list()) body.corners.push_back(corner.vector());
    half_sides = body.half_sides;
  }
  const auto density = place.find("density");
  if (density && place.has("mass")) density->reject("left out where mass is given");
  body.mass = density ? density->number() * volume(*density, body.radius, half_sides) : place["mass"].number();
  world.add(body);
}

template <int Dof>
void add_body(const Place& place, World<Dof>& world) {
  if (const auto plane = place.find("plane")) {
    place.require_keys({"name", "plane"});
    plane->require_keys({"n", "offset"});
    at(*plane, [&] { world.add_plane((*plane)["n"].vector(), (*plane)["offset"].number()); });
  } else if (place.has("fixed") && place["fixed"].flag()) {
    place.require_keys({"name", "fixed", "x", "radius"});
    double radius = 0;
    read(place.find("radius"), radius);
    world.add_fixed(place["x"].vector(), radius);
  } else {
    add_moving(place, world);
  }
}

/// Bodies by number or by name.
class Names {
 public:
  explicit Names(const Place& bodies) {
    for (const Place& body : bodies.list()) {
      if (const auto name = body.find("name"))
        if (!indices_.emplace(name->text(), count_).second) name->reject("another name than those before");
      ++count_;
    }
  }
  int index(const Place& place) const {
    const int i = place.holds_text() ? one_of(place, indices_) : place.whole();
    if (i < 0 || i >= count_) place.reject("the number of a body, less than " + std::to_string(count_));
    return i;
  }

 private:
  std::map<std::string, int> indices_;
  int count_ = 0;
};

template <int Dof>
void add_joint(const Place& place, const Names& names, World<Dof>& world) {
  place.require_keys({"i", "j", "p_i", "p_j", "length", "k", "d"});
  Joint joint{.i = names.index(place["i"]), .j = names.index(place["j"])};
  read(place.find("p_i"), joint.p_i);
  read(place.find("p_j"), joint.p_j);
  read(place.find("length"), joint.length);
  read(place.find("k"), joint.k);
  read(place.find("d"), joint.d);
  world.add_joint(joint);
}

/// Where a body should be, and when.
struct Expected {
  int body;
  double time;  ///< [s]
  Vec3 x;       ///< [m]
  double tolerance;
  double error = std::numeric_limits<double>::quiet_NaN();  ///< in tolerances; until its time has come, none
};

template <int Dof>
class FileScene : public WorldScene<Dof> {
 public:
  FileScene(const Json& json, const Method& method) : WorldScene<Dof>(settings_in<Dof>({json, ""}), method) {
    const Place file(json, "");
    for (const Place& body : file["bodies"].list()) at(body, [&] { add_body(body, this->world_); });
    const Names names(file["bodies"]);
    if (const auto joints = file.find("joints"))
      for (const Place& joint : joints->list()) at(joint, [&] { add_joint(joint, names, this->world_); });
    if (const auto start = file.find("half_step_start"); start && start->flag())
      this->world_.start_half_step_back(this->h_);
    if (const auto expected = file.find("expected"))
      for (const Place& each : expected->list()) {
        each.require_keys({"body", "time", "x", "tolerance"});
        expected_.push_back(
            {names.index(each["body"]), each["time"].number(), each["x"].vector(), each["tolerance"].number()});
        if (!(expected_.back().tolerance > 0)) each["tolerance"].reject("positive");
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
    for (const Expected& each : expected_) error = largest(error, each.error);
    return error;
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

Json parsed(const std::string& file) {
  std::ifstream in(file);
  if (!in) throw std::invalid_argument("the file can not be read");
  try {
    return Json::parse(in);
  } catch (const Json::parse_error& error) {
    // "[json.exception.parse_error.101] parse error at line 1, column 2: ..."
    const std::string what = error.what();
    const std::size_t where = what.find("line ");
    throw std::invalid_argument(where == std::string::npos ? what : what.substr(where));
  }
}

SceneDescription described(const std::string& name, const Json& json) {
  const Place file(json, "");
  file.require_keys({"format", "version", "summary", "model", "h", "time", "solver", "half_step_start",
                     "settings", "bodies", "joints", "expected"});
  if (file["format"].text() != "spook scene") file["format"].reject("\"spook scene\"");
  if (file["version"].whole() != 1) file["version"].reject("1");
  const bool points = one_of<bool>(file["model"], {{"point", true}, {"rigid", false}});
  const bool answered = file.has("expected");
  SceneDescription scene{
      .name = name,
      .summary = file.has("summary") ? file["summary"].text() : "A scene of a file.",
      .answer =
          answered ? "Where bodies should be at certain times, as the file says." : "None: the file has none.",
      .error_name = answered ? "largest distance from where a body should be" : "no answer to compare with",
      .error_unit = answered ? "tolerances" : "of nothing",
      .parameters = {},
      .h = file["h"].number(),
      .time = file["time"].number(),
      .solves = true,
      .build = [json, points](const Parameters&, const Method& method) -> std::unique_ptr<Scene> {
        if (points) return std::make_unique<FileScene<3>>(json, method);
        return std::make_unique<FileScene<6>>(json, method);
      }};
  scene.solver = file.has("solver") ? file["solver"].text() : "auto";
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
  told([&] { return scene.build(Parameters({}), {.h = scene.h, .solver = scene.solver}); });
  return scene;
}

SceneDescription scene_named(const std::string& name) {
  return is_scene_file(name) ? read_scene(name) : find_scene(name);
}

}  // namespace spook
