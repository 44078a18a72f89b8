#include "spook/play_command.hpp"

#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <stdexcept>

#include "recording/recorder.hpp"
#include "scenes/number.hpp"
#include "scenes/registry.hpp"
#include "spook/json.hpp"
#include "spook/scene_file.hpp"

namespace spook {

using Clock = std::chrono::steady_clock;

/// Lines of standard input as they come.
class Input {
 public:
  /// Waits for at most so long [s], for ever when it is negative. False when the input has ended.
  bool wait(double seconds) {
    pollfd watched{.fd = STDIN_FILENO, .events = POLLIN, .revents = 0};
    const int ms = seconds < 0 ? -1 : static_cast<int>(std::ceil(1e3 * seconds));
    if (poll(&watched, 1, ms) <= 0) return true;
    char block[4096];
    const ssize_t count = ::read(STDIN_FILENO, block, sizeof block);
    if (count <= 0) return false;
    text_.append(block, static_cast<std::size_t>(count));
    return true;
  }

  bool next_line(std::string& line) {
    const std::size_t end = text_.find('\n');
    if (end == std::string::npos) return false;
    line = text_.substr(0, end);
    text_.erase(0, end + 1);
    return true;
  }

 private:
  std::string text_;
};

/// The scene, and all that a page can do to it.
class Play {
 public:
  Play(const PlayCommand& command, std::ostream& out)
      : run_(command.run),
        fps_(run_.fps ? parse_number("fps", *run_.fps) : 60),
        out_(out),
        description_(scene_named(run_.scene)) {
    build(nullptr);
  }

  void execute() {
    Input input;
    std::string line;
    Clock::time_point due = Clock::now();
    for (;;) {
      const double until = std::chrono::duration<double>(due - Clock::now()).count();
      if (!input.wait(held() ? -1 : std::max(0.0, until))) return;
      while (input.next_line(line)) obey(line);
      out_.flush();
      if (held()) {
        due = Clock::now();
      } else if (Clock::now() >= due) {
        go(frame_steps_);
        // What cannot keep up runs as fast as it can, and does not hurry after what it missed.
        const auto pause =
            std::chrono::duration<double>(static_cast<double>(frame_steps_) * settings_->method.h / rate_);
        due = std::max(due + std::chrono::duration_cast<Clock::duration>(pause), Clock::now());
      }
    }
  }

 private:
  bool held() const { return paused_ || lost_; }

  /// From what is set now; the bodies go on from where they are in `before`, where they are the same ones.
  void build(const Scene* before) {
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

  void begin() {
    recorder_.emplace(out_, description_, *parameters_, *settings_, fps_);
    recorder_->begin(*scene_, true);
    scene_->observe();
    scene_->judge();
    recorder_->take(*scene_, touched_);
    out_.flush();
  }

  void go(std::int64_t steps) {
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

  void obey(const std::string& line) {
    try {
      const Json command = Json::parse(line);
      for (const auto& [name, value] : command.items()) obey(name, value);
    } catch (const std::exception& error) {  // of the JSON, or of what it asks for
      out_ << Json{{"refused", error.what()}}.dump() << '\n';
    }
  }

  void obey(const std::string& name, const Json& value) {
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

  void touch(const std::string& name, const Json& value) {
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

  static Vec3 vector(const Json& json) {
    const auto numbers = json.get<std::array<double, 3>>();
    return {numbers[0], numbers[1], numbers[2]};
  }

  /// As if it had been typed; where that makes no sense all stays as it was.
  void set(const Json& values) {
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

  RunCommand run_;
  double fps_;
  std::ostream& out_;
  const SceneDescription description_;
  std::optional<Parameters> parameters_;
  std::optional<RunSettings> settings_;
  std::unique_ptr<Scene> scene_;
  std::optional<Recorder> recorder_;
  std::int64_t frame_steps_ = 1;
  double rate_ = 1;
  bool paused_ = false, lost_ = false, touched_ = false;
};

void PlayCommand::execute(std::ostream& out) const {
  Play(*this, out).execute();
}

}  // namespace spook
