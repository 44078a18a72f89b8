#include "engine/solvers/solver_result.hpp"

#include <algorithm>
#include <cmath>

#include "10_convergence/convergence.hpp"
#include "engine/support/larger.hpp"

namespace spook {

std::int64_t SolverResult::updates(std::size_t rows) const {
  return row_updates >= 0 ? row_updates : std::ssize(report.history) * static_cast<std::int64_t>(rows);
}

SolverResult without_updates(SolveReport report) {
  SolverResult result = std::move(report);
  result.row_updates = 0;
  return result;
}

double estimated_error(double residual, const std::vector<double>& history) {
  // A 1 - ρ of 1e-8 is round-off.
  constexpr double least = 1e-8;
  const double rate = observed_rate(history);
  return residual / (rate < 1 ? std::max(1 - rate, least) : least);
}

template <int Dof>
double rhs_norm(const std::vector<Row<Dof>>& rows) {
  double most = 0;
  for (const Row<Dof>& row : rows) most = std::max(most, std::abs(row.B));
  return most;
}

template <int Dof>
double roundings(const std::vector<Row<Dof>>& rows) {
  double returned = 0;
  for (const Row<Dof>& row : rows) returned = std::max(returned, row.diagonal * std::abs(row.lambda));
  return 1e-13 * rhs_norm(rows) + 1e-14 * returned;
}

static void add_trouble(const SolveReport& of, SolveReport& all) {
  if (all.trouble.empty()) all.trouble = of.trouble;
}

SolverResult append(SolverResult first, const SolverResult& second, std::size_t rows) {
  SolveReport& all = first.report;
  first.row_updates = first.updates(rows) + second.updates(rows);
  all.history.insert(all.history.end(), second.report.history.begin(), second.report.history.end());
  all.converged = second.report.converged;
  add_trouble(second.report, all);
  return first;
}

SolverResult merge_parallel(SolverResult one, const SolverResult& other) {
  SolveReport& all = one.report;
  one.row_updates += other.row_updates;
  all.history.resize(std::max(all.history.size(), other.report.history.size()), 0);
  for (std::size_t k = 0; k < other.report.history.size(); ++k)
    all.history[k] = larger(all.history[k], other.report.history[k]);
  all.converged = all.converged && other.report.converged;
  add_trouble(other.report, all);
  return one;
}

template double rhs_norm<3>(const std::vector<Row<3>>&);
template double rhs_norm<6>(const std::vector<Row<6>>&);
template double roundings<3>(const std::vector<Row<3>>&);
template double roundings<6>(const std::vector<Row<6>>&);

}  // namespace spook
