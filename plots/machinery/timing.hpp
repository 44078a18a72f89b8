#pragma once
// Measures the time of work over several runs.
#include <algorithm>
#include <chrono>
#include <vector>

namespace spook::plots {

struct Timing {
  double median, low, high;  ///< [ns]: the median, and the quartiles around it
};

/// Runs `work`, which repeats an operation `count` times, until at least `repeats` runs and 20 ms are over. Returns
/// times of one operation.
template <class Work>
Timing time_each(double count, int repeats, const Work& work) {
  using Clock = std::chrono::steady_clock;
  std::vector<double> times;
  double total = 0;
  while (static_cast<int>(times.size()) < repeats || (total < 2e7 && times.size() < 1000)) {
    const auto start = Clock::now();
    work();
    const double elapsed = std::chrono::duration<double, std::nano>(Clock::now() - start).count();
    total += elapsed;
    times.push_back(elapsed / count);
  }
  std::sort(times.begin(), times.end());
  const auto quantile = [&](double part) {
    return times[static_cast<std::size_t>(part * static_cast<double>(times.size() - 1))];
  };
  return {quantile(0.5), quantile(0.25), quantile(0.75)};
}

}  // namespace spook::plots
