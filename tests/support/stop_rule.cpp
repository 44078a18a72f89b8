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

/// Tells whether `all` starts with `got`.
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
      right ? "The tolerance only decides when to stop: it must not change earlier entries." : c.clue);
  return false;
}

}  // namespace

bool expect_stops_by_the_rule(const std::string& equation, int entries, const SolvesBy& solve) {
  const std::vector<double> all = solve({.max_sweeps = entries, .tolerance = 0}).history;
  expect_true("with max_sweeps = " + std::to_string(entries) +
                  " and tolerance 0 the history has at least three entries; here " + std::to_string(all.size()),
              equation, all.size() >= 3, "Append one entry a sweep.");
  if (all.size() < 3) return false;
  double lowest = infinity;
  for (std::size_t k = 0; k < all.size(); ++k) {
    if (!(all[k] < lowest)) continue;
    lowest = all[k];
    const int last = static_cast<int>(k) + 1;
    const auto as_said = [&](const Case& c) { return expect_as_said(equation, c, all, solve(c.stop)); };
    if (!as_said({{.max_sweeps = 10 * entries, .tolerance = lowest},
                  k + 1,
                  true,
                  "Stop at the first entry that is at most the tolerance, equal to it as well. The tolerance "
                  "is in m/s, as the entries are: it is not relative to the first entry, and not squared. The "
                  "history includes "
                  "the entry that meets it."}))
      return false;
    if (!as_said({{.max_sweeps = last, .tolerance = lowest},
                  k + 1,
                  true,
                  "The last allowed sweep met the tolerance: `converged` says whether the tolerance was met, "
                  "not whether sweeps were left."}))
      return false;
    if (k > 0 && !as_said({{.max_sweeps = last - 1, .tolerance = lowest},
                           k,
                           false,
                           "Only max_sweeps were allowed, and none met the tolerance: it has not converged."}))
      return false;
  }
  return true;
}

bool one_returns_more(const std::vector<double>& history) {
  for (std::size_t k = 1; k + 1 < history.size(); ++k)
    if (history[k] > 1.001 * history[k - 1]) return true;
  return false;
}

/// Sweeps until nothing but round-off is left, where no sweep is better than those before.
static bool goes_on_in_round_off(const std::string& equation, const SolvesBy& solve) {
  const int sweeps = 400;
  const std::vector<double> got = solve({.max_sweeps = sweeps, .tolerance = 0}).history;
  if (std::ssize(got) == sweeps || (!got.empty() && got.back() == 0)) return true;
  report_failure(
      "number of sweeps, with max_sweeps = " + std::to_string(sweeps) + " and tolerance 0", equation,
      "  expected  " + std::to_string(sweeps) + ", unless one returns 0\n  got       " +
          std::to_string(got.size()) + "\n",
      "It gave up, perhaps since some sweeps were no better than those before. That is no reason: only "
      "the tolerance and max_sweeps end it.");
  return false;
}

bool expect_goes_on_when_one_returns_more(const std::string& equation, const std::vector<double>& by_hand,
                                          const SolvesBy& solve) {
  const std::vector<double> got =
      solve({.max_sweeps = static_cast<int>(by_hand.size()), .tolerance = 0}).history;
  std::size_t more = 1;
  while (more + 1 < by_hand.size() && !(by_hand[more] > 1.001 * by_hand[more - 1])) ++more;
  const bool meets_tolerance = !got.empty() && got.back() == 0 && begins_with(by_hand, got);
  if (got.size() == by_hand.size() || meets_tolerance) return goes_on_in_round_off(equation, solve);
  const bool ended_there = (got.size() == more || got.size() == more + 1) && begins_with(by_hand, got);
  if (ended_there) this_failure_explains();
  report_failure(
      "sweeps made of " + std::to_string(by_hand.size()) + ", tolerance 0, of which number " +
          std::to_string(more + 1) + " returns more than the one before, " + show(by_hand[more]) +
          " m/s after " + show(by_hand[more - 1]) + " m/s",
      equation,
      "  expected  " + std::to_string(by_hand.size()) + "\n  got       " + std::to_string(got.size()) + "\n",
      ended_there ? "It ended where a sweep returned more than the one before. Rows that reach bounds, or "
                    "leave them, may cause this: only the tolerance and max_sweeps end it."
                  : "Only the tolerance and max_sweeps end it.");
  return false;
}

}  // namespace spook::testing
