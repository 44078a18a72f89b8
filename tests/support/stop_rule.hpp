#pragma once
// The contract of solve(), which later solvers share: where the sweeps end, and what they say then.
#include <functional>
#include <vector>

#include "04_gauss_seidel/gauss_seidel.hpp"

namespace spook::testing {

/// The problem of a test, always from the same start, by this rule.
using SolvesBy = std::function<SolveReport(const StopRule&)>;

/// It stops at the first entry of its history that is at most the tolerance, in m/s; has converged then, also when this
/// is the last that is allowed; has not when one fewer is; and its history has every entry. Of so many entries.
bool expect_stops_by_the_rule(const std::string& equation, int entries, const SolvesBy& solve);

/// What so many sweeps return by hand, where one of them returns more than the one before: the solver makes them all.
bool expect_goes_on_when_one_returns_more(const std::string& equation, const std::vector<double>& by_hand,
                                          const SolvesBy& solve);

/// Whether an entry is larger than the one before, by more than roundings.
bool one_returns_more(const std::vector<double>& history);

/// All that a solver may change: for expect_rejects, as a rule that makes no sense is refused before anything is touched.
template <int Dof>
std::function<std::vector<double>()> state_of(const std::vector<Row<Dof>>& rows,
                                              const std::vector<Twist<Dof>>& V) {
  return [&rows, &V] {
    std::vector<double> all;
    for (const Row<Dof>& row : rows) all.insert(all.end(), {row.lambda, row.lo, row.hi});
    for (const Twist<Dof>& velocity : V) all.insert(all.end(), velocity.begin(), velocity.end());
    return all;
  };
}

}  // namespace spook::testing
