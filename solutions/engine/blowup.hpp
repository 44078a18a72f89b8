#pragma once
// What a world throws when one of its numbers stops being one.
#include <cstdint>
#include <sstream>
#include <stdexcept>

namespace spook {

/// A position or velocity is no longer finite. What was observed before this step is still good.
class Blowup : public std::runtime_error {
 public:
  Blowup(std::int64_t step, double time, int body)
      : std::runtime_error(describe(step, time, body)), step_(step), time_(time), body_(body) {}

  std::int64_t step() const { return step_; }  ///< the step that did it; the first is 1
  double time() const { return time_; }        ///< at its end [s]
  int body() const { return body_; }           ///< the first body that is not finite

 private:
  static std::string describe(std::int64_t step, double time, int body) {
    std::ostringstream text;
    text << "blew up in step " << step << " (time " << time << " s): body " << body << " is not finite";
    return text.str();
  }

  std::int64_t step_;
  double time_;
  int body_;
};

}  // namespace spook
