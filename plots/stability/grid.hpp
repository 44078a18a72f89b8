#pragma once
// Axes of the maps in this folder.
#include <cmath>
#include <string>
#include <vector>

namespace spook::plots {

/// Returns `count` numbers from `low` to `high`, equally spaced on a logarithmic axis.
inline std::vector<double> log_spaced(double low, double high, int count) {
  std::vector<double> values;
  for (int n = 0; n < count; ++n) values.push_back(low * std::pow(high / low, double(n) / (count - 1)));
  return values;
}

/// Returns `count` whole numbers from `low` to `high`, nearly equally spaced on a logarithmic axis.
inline std::vector<int> whole_log_spaced(double low, double high, int count) {
  std::vector<int> values;
  for (const double value : log_spaced(low, high, count))
    values.push_back(static_cast<int>(std::lround(value)));
  return values;
}

}  // namespace spook::plots
