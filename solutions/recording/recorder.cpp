#include "recording/recorder.hpp"

#include <array>
#include <cmath>

#include "common/require.hpp"
#include "recording/base64.hpp"
#include "recording/controls.hpp"
#include "scenes/run.hpp"
#include "spook/json.hpp"

namespace spook {

static Json numbers(const std::vector<Vec3>& all) {
  Json list = Json::array();
  for (const Vec3& v : all) list.push_back(numbers(v));
  return list;
}

static Json json_of(const Shape& shape) {
  return match(
      shape,
      [](const NoShape&) -> Json {
        return {{"shape", "point"}};
      },
      [](const Sphere& sphere) -> Json {
        return {{"shape", "ball"}, {"radius", sphere.radius}};
      },
      [](const Capsule& capsule) -> Json {
        return {{"shape", "capsule"}, {"radius", capsule.radius}, {"half_length", capsule.half_length}};
      },
      [](const Cuboid& box) -> Json {
        return {{"shape", "box"}, {"half_sides", numbers(box.half_sides)}};
      },
      [](const PointSet& set) -> Json {
        return {{"shape", "corners"}, {"points", numbers(set.points)}};
      });
}

static Json json_of(const Appearance& body) {
  Json json = json_of(body.shape);
  if (body.plane) json = {{"shape", "plane"}, {"n", numbers(body.plane->n)}, {"offset", body.plane->offset}};
  if (body.is_hand) json = {{"shape", "hand"}};
  if (body.is_static) json["fixed"] = true;
  return json;
}

static Json json_of(const Joint& joint) {
  Json json = {{"kind", name_of(joint.kind)}, {"rows", joint.rows()},     {"i", joint.i}, {"j", joint.j},
               {"p_i", numbers(joint.p_i)},   {"p_j", numbers(joint.p_j)}};
  if (joint.length) json["length"] = *joint.length;
  if (joint.is_guided()) {
    json["axis"] = numbers(joint.axis);
    json["rest"] = {joint.rest->w(), joint.rest->x(), joint.rest->y(), joint.rest->z()};
  }
  if (joint.limits) json["limits"] = {joint.limits->lower, joint.limits->upper};
  if (joint.spring) json["spring"] = {{"stiffness", joint.spring->stiffness}, {"rest", joint.spring->rest}};
  if (joint.motor) json["motor"] = {{"speed", joint.motor->speed}, {"strength", joint.motor->strength}};
  return json;
}

/// Formats numbers for a recording.
class Crowd {
 public:
  void add(double value) { values_.push_back(static_cast<float>(value)); }
  void add(const Vec3& v) {
    for (const double component : v) add(component);
  }
  void add(const Quat& q) {
    for (const double component : {q.w(), q.x(), q.y(), q.z()}) add(component);
  }
  template <class Value>
  void add(const std::vector<Value>& values) {
    for (const Value& value : values) add(value);
  }
  std::string text() const { return base64(values_); }

 private:
  std::vector<float> values_;
};

template <class Values>
static std::string text_of(const Values& values) {
  Crowd crowd;
  crowd.add(values);
  return crowd.text();
}

static void add_contacts(const std::vector<Touch>& contacts, Json& json) {
  if (contacts.empty()) return;
  std::vector<std::int32_t> between;
  Crowd crowd;
  for (const Touch& touch : contacts) {
    between.insert(between.end(), {touch.i, touch.j});
    crowd.add(touch.point);
    crowd.add(touch.n);
    crowd.add(touch.gap);
    crowd.add(touch.impulse);
  }
  json["between"] = base64(between);
  json["contacts"] = crowd.text();
}

static void add_ghosts(const std::vector<Ghost>& ghosts, bool turned, Json& json) {
  if (ghosts.empty()) return;
  std::vector<int> bodies;
  Crowd crowd;
  for (const Ghost& ghost : ghosts) {
    bodies.push_back(ghost.body);
    crowd.add(ghost.x);
    if (turned) crowd.add(ghost.q);
  }
  json["ghost_bodies"] = bodies;
  json["ghost"] = crowd.text();
}

std::int64_t steps_of_frame(double h, double per_second) {
  require_positive("fps", per_second);
  return static_cast<std::int64_t>(std::clamp(std::round(1 / (per_second * h)), 1.0, 1e9));
}

Recorder::Recorder(std::ostream& out, const SceneDescription& description, const Parameters& parameters,
                   const RunSettings& settings, double per_second)
    : out_(out),
      description_(description),
      parameters_(parameters),
      settings_(settings),
      steps_(steps_of_frame(settings.method.h, per_second)) {}

void Recorder::begin(const Scene& scene, bool live) {
  const Picture picture = scene.picture();
  Json bodies = Json::array(), joints = Json::array(), curves = Json::array();
  for (const Appearance& body : picture.bodies) bodies.push_back(json_of(body));
  for (const Joint& joint : picture.joints) joints.push_back(json_of(joint));
  for (const Curve& curve : scene.curves())
    curves.push_back({{"name", curve.name}, {"points", numbers(curve.points)}});
  Json header = {{"format", "spook recording"},
                 {"version", 1},
                 {"scene", description_.name},
                 {"summary", description_.summary},
                 {"answer", description_.answer},
                 {"chaotic", description_.chaotic},
                 {"parameters", json_of(parameters_)},
                 {"method", json_of(settings_.method, description_.solves)},
                 {"frame_time", static_cast<double>(steps_) * settings_.method.h},
                 {"time", settings_.time},
                 {"error", {{"name", description_.error_name}, {"unit", description_.error_unit}}},
                 {"columns", scene.columns()},
                 {"stages", stage_names},
                 {"bodies", bodies},
                 {"joints", joints},
                 {"curves", curves}};
  if (live) {
    header["live"] = true;
    header["controls"] = controls(description_, parameters_, settings_.method);
  }
  last_ = scene.stage_times();
  last_step_ = scene.frame().step;
  write(header.dump());
}

void Recorder::look(Scene& scene, std::int64_t substep) {
  if (substep == 0) {
    scene.time_stages();
    begin(scene);
  }
  if (substep % (steps_ * settings_.method.substeps) == 0) take(scene);
}

std::vector<double> Recorder::us_since_last(const Scene& scene, std::int64_t step) {
  const StageTimes now = scene.stage_times();
  const auto steps =
      static_cast<double>(std::max<std::int64_t>(1, step - last_step_)) / settings_.method.substeps;
  std::vector<double> us;
  for (std::size_t s = 0; s < stage_names.size(); ++s)
    us.push_back(1e6 * (now.seconds[s] - last_.seconds[s]) / steps);
  last_ = now;
  last_step_ = step;
  return us;
}

void Recorder::take(const Scene& scene, bool touched) {
  const Frame frame = scene.frame();
  const StepReport report = scene.report();
  Json line = {{"time", frame.time}, {"step", frame.step}, {"x", text_of(frame.x)}, {"v", text_of(frame.v)}};
  if (!frame.q.empty()) {
    line["q"] = text_of(frame.q);
    line["omega"] = text_of(frame.omega);
  }
  add_contacts(frame.contacts, line);
  if (!frame.joint_impulses.empty()) line["joint_impulses"] = text_of(frame.joint_impulses);
  add_ghosts(scene.ghosts(), !frame.q.empty(), line);
  line["sample"] = known_sample(scene);
  line["error"] = scene.error();
  const Energy& energy = frame.energy;
  line["energy"] = {{"motion", energy.motion},
                    {"turning", energy.turning},
                    {"weight", energy.weight},
                    {"field", energy.field},
                    {"springs", energy.springs}};
  line["residual"] = report.residual;
  line["iterations"] = report.iterations;
  const Verdict& verdict = scene.verdict();
  line["state"] = name_of(verdict.state);
  if (verdict.state != State::sound) line["why"] = verdict.reason;
  line["pairs"] = report.pairs;
  line["us"] = us_since_last(scene, frame.step);
  if (touched) line["touched"] = true;
  const std::string text = line.dump();
  frame_bytes_ = static_cast<double>(text.size());
  write(text);
}

std::int64_t Recorder::frames() const {
  return step_count(settings_.method.h, settings_.time) / steps_ + 1;
}

void Recorder::end(const std::string& why) {
  Json line = {{"end", why.empty() ? "done" : "blown up"}};
  if (!why.empty()) line["why"] = why;
  write(line.dump());
}

void Recorder::write(const std::string& line) {
  out_ << line << '\n';
}

}  // namespace spook
