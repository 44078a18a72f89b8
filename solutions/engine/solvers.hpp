#pragma once
// The solvers, behind one signature, so that an experiment can swap them by name.
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "04_gauss_seidel/gauss_seidel.hpp"

namespace spook {

/// What a solver did.
struct Outcome {
  Outcome(SolveReport done) : report(std::move(done)) {}  // NOLINT: a chapter's solver is one, too

  SolveReport report;
  std::int64_t row_updates = -1;  ///< that were made; -1: one of each row for each entry of the history
};

/// Brings the rows' λ to S λ = B within their bounds, and V to M⁻¹ Gᵀ λ. Both start from what the caller left in
/// them. May keep what helps it in the next step.
template <int Dof>
using Solver =
    std::function<Outcome(std::vector<Row<Dof>>& rows, std::vector<Twist<Dof>>& V, const StopRule& stop)>;

template <int Dof>
struct NamedSolver {
  std::string name;
  std::string summary;
  Solver<Dof> (*make)();             ///< with nothing kept yet
  bool geometric_stiffness = false;  ///< to be used with Settings::geometric_stiffness
};

/// All there are; the first is the default. The names do not depend on Dof.
template <int Dof>
const std::vector<NamedSolver<Dof>>& solvers();

/// Throws std::invalid_argument, with the nearest name there is, for a name that is not one of them.
template <int Dof>
const NamedSolver<Dof>& find_solver(const std::string& name);

}  // namespace spook
