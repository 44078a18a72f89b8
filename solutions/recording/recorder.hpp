#pragma once
// Writes a recording, line by line: see README.md for its form.
#include <ostream>

#include "scenes/run.hpp"

namespace spook {

/// How often a frame is taken: the steps between two, so that there are about `per_second` of them in a simulated
/// second, and at least one. Throws std::invalid_argument unless per_second is positive.
std::int64_t steps_of_frame(double h, double per_second);

class Recorder {
 public:
  /// `description`, `parameters` and `settings` must outlive it.
  Recorder(std::ostream& out, const SceneDescription& description, const Parameters& parameters,
           const RunSettings& settings, double per_second);

  /// The first line. A live one tells what can be set.
  void begin(const Scene& scene, bool live = false);

  /// A frame, if it is time for one after so many substeps; before the first the header.
  void look(Scene& scene, std::int64_t substep);

  /// A frame now. Touched: a hand was laid on the scene.
  void take(const Scene& scene, bool touched = false);

  /// How many frames there will be, and what they take, from the first one [bytes]. Contacts add to it.
  std::int64_t frames() const;
  double expected_bytes() const { return static_cast<double>(frames()) * frame_bytes_; }

  /// The last line, and why the run blew up, if it did.
  void end(const std::string& why = "");

 private:
  void write(const std::string& line);
  std::vector<double> us_since_last(const Scene& scene, std::int64_t step);

  std::ostream& out_;
  const SceneDescription& description_;
  const Parameters& parameters_;
  const RunSettings& settings_;
  std::int64_t steps_;  // from frame to frame
  StageTimes last_;     // at the last frame
  std::int64_t last_step_ = 0;
  double frame_bytes_ = 0;  // of the last frame
};

}  // namespace spook
