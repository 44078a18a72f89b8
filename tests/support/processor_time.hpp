#pragma once
// How long work takes the processor: only ever to compare two ways of doing the same, in one run.
#include <ctime>

#include <algorithm>
#include <functional>
#include <limits>

namespace spook::testing {

/// The processor time [s] of another process that works for this one; graded programs have one.
inline double (*seconds_elsewhere)() = nullptr;

/// The shortest of a few times [s] of this thread, and of what works for it: whatever else the machine does has no part in it. Not std::clock,
/// which counts in ticks of some milliseconds where the time of a process is limited.
inline double least_seconds(int repeats, const std::function<void()>& work) {
  const auto now = [] {
    timespec time{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec) +
           (seconds_elsewhere ? seconds_elsewhere() : 0);
  };
  double least = std::numeric_limits<double>::infinity();
  for (int repeat = 0; repeat < repeats; ++repeat) {
    const double start = now();
    work();
    least = std::min(least, now() - start);
  }
  return least;
}

}  // namespace spook::testing
