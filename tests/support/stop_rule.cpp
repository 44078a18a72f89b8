#include "stop_rule.hpp"

#include <algorithm>
#include <cmath>

#include "checks.hpp"

namespace spook::testing {

namespace {

struct Case {
  StopRule stop;
  std::size_t entries;
  bool converged;
  std::string clue;
};

/// Whether one is the beginning of the other.
bool begins_with(const std::vector<double>& all, const std::vector<double>& got) {
  const auto alike = [](double a, double b) { return std::abs(a - b) <= 1e-9 * std::abs(b); };
  return got.size() <= all.size() && std::equal(got.begin(), got.end(), all.begin(), alike);
}

bool expect_as_said(const std::string& equation, const Case& c, const std::vector<double>& all,
                    const SolveReport& got) {
  const auto entries = [](std::size_t count) { return std::to_string(count) + " entries, "; };
  const auto state = [](bool converged) { return converged ? "converged" : "not converged"; };
  const bool right = got.history.size() == c.entries && got.converged == c.converged;
  if (right && begins_with(all, got.history)) return true;
  if (!right) this_failure_explains();
  report_failure(
      "max_sweeps = " + std::to_string(c.stop.max_sweeps) + " and a tolerance of " + show(c.stop.tolerance) +
          " m/s, with the history " +
          show(Eigen::Map<const Eigen::VectorXd>(all.data(), std::min<Eigen::Index>(std::ssize(all), 8))
                   .eval()) +
          " m/s",
      equation,
      "  expected  " + entries(c.entries) + state(c.converged) + "\n  got       " +
          entries(got.history.size()) + state(got.converged) +
          (right ? "; but other entries than without a tolerance" : "") + "\n",
      right ? "The tolerance says when to stop, and changes nothing before." : c.clue);
  return false;
}

}  // namespace

bool expect_stops_by_the_rule(const std::string& equation, int entries, const SolvesBy& solve) {
  const std::vector<double> all = solve({.max_sweeps = entries, .tolerance = 0}).history;
  expect_true("of " + std::to_string(entries) +
                  " entries without a tolerance there are at least three: " + std::to_string(all.size()),
              equation, all.size() >= 3, "One entry a sweep.");
  if (all.size() < 3) return false;
  double lowest = infinity;
  for (std::size_t k = 0; k < all.size(); ++k) {
    if (!(all[k] < lowest)) continue;
    lowest = all[k];
    const int last = static_cast<int>(k) + 1;
    const auto as_said = [&](const Case& c) { return expect_as_said(equation, c, all, solve(c.stop)); };
    if (!as_said(
            {{.max_sweeps = 10 * entries, .tolerance = lowest},
             k + 1,
             true,
             "It stops at the first entry that is at most the tolerance, equal to it as well. The tolerance is "
             "in m/s, as the entries are: not a part of the first, and no square. The entry that is good "
             "enough "
             "is one of the history."}))
      return false;
    if (!as_said({{.max_sweeps = last, .tolerance = lowest},
                  k + 1,
                  true,
                  "The last sweep that is allowed was good enough: `converged` is whether the tolerance was "
                  "met, not "
                  "whether there were sweeps left."}))
      return false;
    if (k > 0 && !as_said({{.max_sweeps = last - 1, .tolerance = lowest},
                           k,
                           false,
                           "There were only max_sweeps, and none was good enough: it has not converged."}))
      return false;
  }
  return true;
}

}  // namespace spook::testing
