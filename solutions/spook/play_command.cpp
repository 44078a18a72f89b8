#include "spook/play_command.hpp"

#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "spook/play.hpp"

namespace spook {

using Clock = std::chrono::steady_clock;

static constexpr double longest_pause = 86400;  // [s], which the clock and poll() can count

/// Reads lines of standard input as they arrive.
class Input {
 public:
  /// Waits for a line for at most so long [s], without limit if negative. Returns false when the input has ended.
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

void PlayCommand::execute(std::ostream& out) const {
  Play play(run, out);
  Input input;
  std::string line;
  Clock::time_point due = Clock::now();
  for (;;) {
    const double until = std::chrono::duration<double>(due - Clock::now()).count();
    if (!input.wait(play.held() ? -1 : std::max(0.0, until))) return;
    while (input.next_line(line)) play.line(line);
    out.flush();
    if (play.held()) {
      due = Clock::now();
    } else if (Clock::now() >= due) {
      play.frame();
      // A run slower than real time runs at full speed, and does not catch up.
      const auto pause = std::chrono::duration<double>(std::min(play.frame_seconds(), longest_pause));
      due = std::max(due + std::chrono::duration_cast<Clock::duration>(pause), Clock::now());
    }
  }
}

}  // namespace spook
