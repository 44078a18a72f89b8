#include "spook/play.hpp"

#include <algorithm>
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
    out_ << Json{{"refused", error.what()}}.dump() << '\n';
  }
}

void Play::frame() {
  if (!held()) go(frame_steps_);
}

double Play::frame_seconds() const {
  return static_cast<double>(frame_steps_) * settings_->method.h / rate_;
}

/// Builds the scene with the current options. Its bodies continue from `before` if both scenes have the same bodies.
void Play::build(const Scene* before) {
  Parameters parameters = run_.parameters(description_);
  RunSettings settings = run_.settings(description_);
  std::unique_ptr<Scene> scene = description_.build(parameters, settings.method);
  scene->time_stages();
  const bool goes_on = before && scene->take_state_from(*before);
  touched_ = goes_on && touched_;
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
  scene_->observe();
  scene_->judge();
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
  }
  out_.flush();
}

void Play::obey(const std::string& name, const Json& value) {
  if (name == "pause") {
    paused_ = value.get<bool>();
  } else if (name == "step") {
    if (!lost_) go(std::clamp<std::int64_t>(value.get<std::int64_t>(), 1, 1'000'000));
  } else if (name == "restart") {
    build(nullptr);
  } else if (name == "rate") {
    const double rate = value.get<double>();
    if (!(rate > 0 && rate <= 100)) throw std::invalid_argument("rate must be more than 0 and at most 100");
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

void Play::touch(const std::string& name, const Json& value) {
  Hand& hand = scene_->hand();
  bool is_other_picture = false;
  if (name == "pull") {
    is_other_picture =
        hand.pull(value.at("body").get<int>(), vector(value.at("point")), vector(value.at("to")));
  } else if (name == "release") {
    is_other_picture = hand.let_go();
  } else if (name == "push") {
    hand.apply_central_impulse(value.at("body").get<int>(), vector(value.at("impulse")));
  } else if (name == "drop") {
    hand.drop(vector(value.at("x")), value.at("radius").get<double>(), value.at("mass").get<double>());
    is_other_picture = true;
  } else {
    throw std::invalid_argument("unknown command \"" + name + "\"");
  }
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
