#pragma once
// Writes a recording line by line; README.md describes the format.
#include <ostream>

#include "scenes/run.hpp"

namespace spook {

/// Returns the number of steps between frames, at least one, for about `per_second` frames in a simulated second.
/// Throws std::invalid_argument unless per_second is positive.
std::int64_t steps_of_frame(double h, double per_second);

class Recorder {
 public:
  /// Keeps references: `out`, `description`, `parameters` and `settings` must outlive the recorder.
  Recorder(std::ostream& out, const SceneDescription& description, const Parameters& parameters,
           const RunSettings& settings, double per_second);

  /// Writes the header. The header of a live recording lists the controls.
  void begin(const Scene& scene, bool live = false);

  /// Writes a frame if one is due after so many substeps; writes the header before the first frame.
  void look(Scene& scene, std::int64_t substep);

  /// Writes a frame now. `touched`: a user has interacted with the scene.
  void take(const Scene& scene, bool touched = false);

  /// The number of frames of the whole run, and their size estimated from the first one [bytes]. Contacts add to the
  /// size.
  std::int64_t frames() const;
  double expected_bytes() const { return static_cast<double>(frames()) * frame_bytes_; }

  /// Writes the last line, with the reason `why` if the run diverged.
  void end(const std::string& why = "");

 private:
  void write(const std::string& line);
  std::vector<double> us_since_last(const Scene& scene, std::int64_t step);

  std::ostream& out_;
  const SceneDescription& description_;
  const Parameters& parameters_;
  const RunSettings& settings_;
  std::int64_t steps_;  // between two frames
  StageTimes last_;     // stage times at the last frame
  std::int64_t last_step_ = 0;
  double frame_bytes_ = 0;  // of the last frame
};

}  // namespace spook
