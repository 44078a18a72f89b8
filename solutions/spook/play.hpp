#pragma once
// A scene as it runs, and all that a page can do to it: commands and frames as recording/README.md has them. Keeps no
// clock: whoever has one calls frame() when frame_seconds() have gone by.
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
  /// Opens the scene and writes its header and first frame to `out`, which must outlive it. Throws
  /// std::invalid_argument for whatever makes no sense, before anything is written.
  Play(const RunCommand& run, std::ostream& out);

  /// Obeys one line of JSON. A command that makes no sense is answered by a line {"refused": why}.
  void line(const std::string& text);

  /// Advances by one frame and writes it; nothing while it is held.
  void frame();

  /// True while a page has paused the run, and once the run is lost.
  bool held() const { return paused_ || lost_; }

  /// Time from one frame to the next on the clock of who watches [s].
  double frame_seconds() const;

 private:
  void build(const Scene* before);
  void begin();
  void go(std::int64_t steps);
  void obey(const std::string& name, const Json& value);
  void touch(const std::string& name, const Json& value);
  void set(const Json& values);

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
