#pragma once
// The contract of solve(), which later solvers share: when sweeps stop, and what is reported.
#include <functional>
#include <vector>

#include "04_gauss_seidel/gauss_seidel.hpp"

namespace spook::testing {

/// Solves a test's problem, always from the same start, with this stop rule.
using SolvesBy = std::function<SolveReport(const StopRule&)>;

/// Expects that the solver stops at the first history entry of at most the tolerance, in m/s, and has then converged,
/// also if this is the last allowed sweep. With one sweep fewer it has not converged. The history must have all
/// `entries`.
bool expect_stops_by_the_rule(const std::string& equation, int entries, const SolvesBy& solve);

/// Expects that the solver makes all sweeps although one returns more than the sweep before, or many are no better than
/// those before. Compares the history with sweeps by hand.
bool expect_goes_on_when_one_returns_more(const std::string& equation, const std::vector<double>& by_hand,
                                          const SolvesBy& solve);

/// Tells whether an entry is larger than the one before, by more than round-off.
bool one_returns_more(const std::vector<double>& history);

/// Everything that a solver may change, for expect_rejects: an invalid stop rule must be refused before anything
/// changes.
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
