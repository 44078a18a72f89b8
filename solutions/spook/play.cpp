#include "spook/play.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "scenes/number.hpp"
#include "scenes/registry.hpp"
#include "spook/scene_file.hpp"

namespace spook {

Play::Play(const RunCommand& run, std::ostream& out)
    : run_(run),
      fps_(run_.fps ? parse_number("fps", *run_.fps) : 60),
      out_(out),
      description_(scene_named(run_.scene)) {
  build(nullptr);
}

void Play::line(const std::string& text) {
  try {
    const Json command = Json::parse(text);
    for (const auto& [name, value] : command.items()) obey(name, value);
  } catch (const std::exception& error) {  // invalid JSON, or an invalid command
    refuse(error.what());
  }
}

void Play::refuse(const std::string& why) {
  out_ << Json{{"refused", why}}.dump() << '\n';
}

void Play::frame() {
  if (!held()) go(frame_steps_);
}

double Play::frame_seconds() const {
  return static_cast<double>(frame_steps_) * settings_->method.h / rate_;
}

/// Builds the scene with the current options. Its bodies continue from `before` if both scenes have the same bodies of
/// the same sizes. Answers hold from the start of a run with the same parameters. So with other ones the run is touched,
/// and otherwise what the scene has computed is kept. A refused scene changes nothing.
void Play::build(Scene* before) {
  Parameters parameters = run_.parameters(description_);
  RunSettings settings = run_.settings(description_);
  std::unique_ptr<Scene> scene = description_.build(parameters, settings.method);
  scene->time_stages();
  const bool goes_on = before && scene->take_state_from(*before);
  const bool is_same = goes_on && json_of(parameters) == json_of(*parameters_);
  if (is_same)
    scene->take_results_from(*before);
  else
    scene->observe();
  scene->judge();
  if (settings.method.engine == Engine::plain) plain_step_of(*scene, settings.method);
  touched_ = goes_on && (touched_ || !is_same);
  scene_ = std::move(scene);
  parameters_.emplace(std::move(parameters));
  settings_.emplace(std::move(settings));
  frame_steps_ = steps_of_frame(settings_->method.h, fps_);
  lost_ = false;
  begin();
}

void Play::begin() {
  recorder_.emplace(out_, description_, *parameters_, *settings_, fps_);
  recorder_->begin(*scene_, true);
  recorder_->take(*scene_, touched_);
  out_.flush();
}

void Play::go(std::int64_t steps) {
  try {
    for (std::int64_t n = 0; n < steps * settings_->method.substeps; ++n) {
      scene_->advance(1);
      scene_->observe();
      scene_->judge();
    }
    recorder_->take(*scene_, touched_);
  } catch (const std::runtime_error& error) {
    lost_ = true;
    recorder_->end(error.what());
  } catch (const std::exception& error) {  // a step that the engine refuses
    paused_ = true;
    refuse(error.what());
  }
  out_.flush();
}

/// Returns a whole number. Throws std::invalid_argument, naming the number, for any other.
static std::int64_t whole(const std::string& name, const Json& json) {
  const double number = json.get<double>();
  if (!(std::abs(number) <= 1e9 && number == std::round(number)))
    throw std::invalid_argument(name + " must be a whole number up to 1e9, but is " + exact_text(number));
  return static_cast<std::int64_t>(number);
}

void Play::obey(const std::string& name, const Json& value) {
  if (name == "pause") {
    paused_ = value.get<bool>();
  } else if (name == "step") {
    const std::int64_t steps = whole(name, value);
    if (!lost_) go(std::clamp<std::int64_t>(steps, 1, 1'000'000));
  } else if (name == "restart") {
    build(nullptr);
  } else if (name == "rate") {
    const double rate = value.get<double>();
    if (!(rate >= 1e-4 && rate <= 100))
      throw std::invalid_argument("rate must be from 1e-4 to 100, but is " + exact_text(rate));
    rate_ = rate;
  } else if (name == "set") {
    set(value);
  } else {
    touch(name, value);
  }
}

static Vec3 vector(const Json& json) {
  const auto numbers = json.get<std::array<double, 3>>();
  return {numbers[0], numbers[1], numbers[2]};
}

static int body_of(const Json& value) {
  return static_cast<int>(whole("body", value.at("body")));
}

/// Obeys a command of the hand. Returns true if the scene has other bodies or joints then.
static bool move(Hand& hand, const std::string& name, const Json& value) {
  if (name == "pull") return hand.pull(body_of(value), vector(value.at("point")), vector(value.at("to")));
  if (name == "release") return hand.let_go();
  if (name == "push") {
    hand.apply_central_impulse(body_of(value), vector(value.at("impulse")));
    return false;
  }
  if (name != "drop") throw std::invalid_argument("unknown command \"" + name + "\"");
  hand.drop(vector(value.at("x")), value.at("radius").get<double>(), value.at("mass").get<double>());
  return true;
}

/// Throws as plain_step_of if no step runs the scene after a command. Only a copy of the scene obeys it.
void Play::require_plain_step_after(const std::string& name, const Json& value) const {
  const std::unique_ptr<Scene> copy = description_.build(*parameters_, settings_->method);
  copy->take_state_from(*scene_);
  move(copy->hand(), name, value);
  plain_step_of(*copy, settings_->method);
}

void Play::touch(const std::string& name, const Json& value) {
  if (settings_->method.engine == Engine::plain) require_plain_step_after(name, value);
  const bool is_other_picture = move(scene_->hand(), name, value);
  touched_ = true;
  if (is_other_picture) begin();
}

/// Sets options as if typed; an invalid option changes nothing.
void Play::set(const Json& values) {
  const RunCommand before = run_;
  try {
    for (const auto& [name, value] : values.items())
      run_.retype(name, value.is_string() ? value.get<std::string>() : exact_text(value.get<double>()));
    build(scene_.get());
  } catch (...) {
    run_ = before;
    throw;
  }
}

}  // namespace spook
