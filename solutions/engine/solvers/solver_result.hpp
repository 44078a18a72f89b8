#pragma once
// The result of a solver, and functions that combine results.
#include <cstdint>

#include "04_gauss_seidel/gauss_seidel.hpp"

namespace spook {

struct SolverResult {
  SolverResult(SolveReport done) : report(std::move(done)) {}  // NOLINT: a chapter's solver is one, too

  SolveReport report;
  std::int64_t row_updates = -1;  ///< number of row updates; -1: one of each row for each history entry

  /// Returns the number of row updates of a solve with so many rows.
  std::int64_t updates(std::size_t rows) const;
};

/// Returns the result of a solver that updates no rows.
SolverResult without_updates(SolveReport report);

/// Estimates the error that a solve left [m/s]: r/(1 - ρ), with the residual r and the rate ρ of its history, Eq.
/// (10.5). Slow convergence leaves an error larger than the residual. Without a rate below 1, assumes no convergence.
double estimated_error(double residual, const std::vector<double>& history);

/// Returns the largest |B| of the rows [m/s].
template <int Dof>
double rhs_norm(const std::vector<Row<Dof>>& rows);

/// Returns the round-off of the residual at the current λ [m/s]: Eq. (11.13).
template <int Dof>
double roundings(const std::vector<Row<Dof>>& rows);

/// Combines two consecutive solves. Concatenates the histories; the second solve decides whether the result converged.
/// If a solve does not count its row updates, they are computed from the number of rows.
SolverResult append(SolverResult first, const SolverResult& second, std::size_t rows);

/// Combines two independent solves, both of which count their row updates. Each history entry is the larger of the two,
/// or NaN if one is NaN. The result converged if both did.
SolverResult merge_parallel(SolverResult one, const SolverResult& other);

}  // namespace spook
