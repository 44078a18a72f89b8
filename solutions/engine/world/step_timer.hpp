#pragma once
// The stages of a step, and the time that each takes.
#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <string>

namespace spook {

enum class Stage { contacts, forces, impacts, rows, solve, integrate };

inline constexpr std::array<const char*, 6> stage_names = {"contacts", "forces", "impacts",
                                                           "rows",     "solve",  "integrate"};

/// Total time and number of runs of each stage.
struct StageTimes {
  std::array<double, stage_names.size()> seconds{};
  std::array<std::int64_t, stage_names.size()> runs{};
};

/// Runs stages, and times them only after start(): reading the clock takes longer than the whole step of a point mass.
class StepTimer {
 public:
  void start() { running_ = true; }
  const StageTimes& times() const { return times_; }

  template <class Work>
  void run(Stage stage, const Work& work) {
    if (!running_) return work();
    const auto start = Clock::now();
    work();
    const auto s = static_cast<std::size_t>(stage);
    times_.seconds[s] += std::chrono::duration<double>(Clock::now() - start).count();
    ++times_.runs[s];
  }

 private:
  using Clock = std::chrono::steady_clock;
  bool running_ = false;
  StageTimes times_;
};

}  // namespace spook
