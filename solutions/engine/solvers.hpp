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

  /// Row updates that were made, of so many rows.
  std::int64_t updates(std::size_t rows) const;
};

/// Of two solves, one after the other. A history goes on where the other ends; the second says whether it converged.
/// Where one does not count its row updates, they are of so many rows.
Outcome in_turn(Outcome first, const Outcome& second, std::size_t rows);

/// Of two solves that have no part in each other, and count their row updates. A history has the larger of their
/// entries, or a NaN; both must have converged.
Outcome side_by_side(Outcome one, const Outcome& other);

/// Brings the rows' λ to S λ = B within their bounds, and V to M⁻¹ Gᵀ λ. Both start from what the caller left in
/// them. May keep what helps it in the next step.
template <int Dof>
using Solver =
    std::function<Outcome(std::vector<Row<Dof>>& rows, std::vector<Twist<Dof>>& V, const StopRule& stop)>;

template <int Dof>
struct NamedSolver {
  std::string name;
  std::string summary;
  std::string iteration;             ///< what an entry of its history is of, one of them
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
