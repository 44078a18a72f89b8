#pragma once
// What a solver did, and how that of several is put together.
#include <cstdint>

#include "04_gauss_seidel/gauss_seidel.hpp"

namespace spook {

struct SolverResult {
  SolverResult(SolveReport done) : report(std::move(done)) {}  // NOLINT: a chapter's solver is one, too

  SolveReport report;
  std::int64_t row_updates = -1;  ///< that were made; -1: one of each row for each entry of the history

  /// Row updates that were made, of so many rows.
  std::int64_t updates(std::size_t rows) const;
};

/// Of a solver that updates no rows.
SolverResult without_updates(SolveReport report);

/// What a solve left [m/s]: its residual r as r/(1 - ρ), with the rate ρ of its history, Eq. (10.5). One that creeps has
/// farther to go than its last sweep tells; without a rate below 1, assumes no convergence.
double estimated_error(double residual, const std::vector<double>& history);

/// What the rows of a step ask for: the largest |B| [m/s].
template <int Dof>
double rhs_norm(const std::vector<Row<Dof>>& rows);

/// What roundings leave, of the λ that rows have [m/s]: Eq. (11.13).
template <int Dof>
double roundings(const std::vector<Row<Dof>>& rows);

/// Of two solves, one after the other. A history goes on where the other ends; the second says whether it converged.
/// Where one does not count its row updates, they are of so many rows.
SolverResult append(SolverResult first, const SolverResult& second, std::size_t rows);

/// Of two solves that have no part in each other, and count their row updates. A history has the larger of their
/// entries, or a NaN; both must have converged.
SolverResult merge_parallel(SolverResult one, const SolverResult& other);

}  // namespace spook
