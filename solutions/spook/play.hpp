#pragma once
// A running scene that obeys the commands of a page. recording/README.md describes commands and frames. Keeps no clock:
// the caller calls frame() every frame_seconds().
#include <memory>
#include <optional>
#include <ostream>
#include <string>

#include "recording/recorder.hpp"
#include "spook/json.hpp"
#include "spook/run_command.hpp"

namespace spook {

class Play {
 public:
  /// Opens the scene and writes its header and first frame to `out`, which must outlive this object. Throws
  /// std::invalid_argument for an invalid option, before it writes anything.
  Play(const RunCommand& run, std::ostream& out);

  /// Obeys one line of JSON. Answers an invalid command by a line {"refused": why}.
  void line(const std::string& text);

  /// Advances by one frame and writes it. Does nothing while held. If a step throws, it writes why: a run that diverges
  /// is lost, and any other run is paused.
  void frame();

  /// Tells whether a page has paused the run, or the run is lost.
  bool held() const { return paused_ || lost_; }

  /// The real time between two frames [s].
  double frame_seconds() const;

 private:
  void build(Scene* before);
  void begin();
  void go(std::int64_t steps);
  void obey(const std::string& name, const Json& value);
  void touch(const std::string& name, const Json& value);
  void require_plain_step_after(const std::string& name, const Json& value) const;
  void set(const Json& values);
  void refuse(const std::string& why);

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

}  // namespace spook
