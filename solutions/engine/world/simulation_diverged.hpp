#pragma once
// What a world throws when it cannot go on.
#include <cstdint>
#include <sstream>
#include <stdexcept>

namespace spook {

/// A position or velocity is no longer finite, or a distance has lost its direction. What was observed before this
/// step is still good.
class SimulationDiverged : public std::runtime_error {
 public:
  SimulationDiverged(std::int64_t step, double time, int body, const std::string& what = "is not finite")
      : std::runtime_error(describe(step, time, body, what)), step_(step), time_(time), body_(body) {}

  std::int64_t step() const { return step_; }  ///< the step that did it; the first is 1
  double time() const { return time_; }        ///< at its end [s]
  int body() const { return body_; }           ///< the first body that it happened to

 private:
  static std::string describe(std::int64_t step, double time, int body, const std::string& what) {
    std::ostringstream text;
    text << "blew up in step " << step << " (time " << time << " s): body " << body << ' ' << what;
    return text.str();
  }

  std::int64_t step_;
  double time_;
  int body_;
};

}  // namespace spook
