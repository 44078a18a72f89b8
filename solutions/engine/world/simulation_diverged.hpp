#pragma once
// The exception of a step whose result is not finite.
#include <cstdint>
#include <sstream>
#include <stdexcept>

namespace spook {

/// A position or velocity is no longer finite, or the direction of a distance joint is undefined. Results of earlier
/// steps are valid.
class SimulationDiverged : public std::runtime_error {
 public:
  SimulationDiverged(std::int64_t step, double time, int body, const std::string& what = "is not finite")
      : std::runtime_error(describe(step, time, body, what)), step_(step), time_(time), body_(body) {}

  std::int64_t step() const { return step_; }  ///< the failed step; the first step is 1
  double time() const { return time_; }        ///< at the end of that step, or of its failed part [s]
  int body() const { return body_; }           ///< the first affected body

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
