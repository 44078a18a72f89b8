#pragma once
// Solves rows whose bounds turn out not to matter, by given factors of S: Eq. (11.1), (11.3), refined once, Eq.
// (11.14).
#include <algorithm>
#include <cmath>
#include <optional>

#include "09_better_friction/better_friction.hpp"
#include "engine/solvers/solver_result.hpp"

namespace spook {

/// Sets x to the residual of each row, Eq. (4.6).
template <int Dof, class Values>
void set_residuals(const std::vector<Row<Dof>>& rows, const std::vector<Twist<Dof>>& V, Values& x) {
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const Row<Dof>& row = rows[k];
    x[k] = row.B - row.Gi.dot(V[row.i]) - row.Gj.dot(V[row.j]) - row.Sigma * row.lambda;
  }
}

/// Adds impulses to the rows, within their bounds, and what they cause to V.
template <int Dof, class Values>
void add_impulses(const Values& more, std::vector<Row<Dof>>& rows, std::vector<Twist<Dof>>& V) {
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const double before = rows[k].lambda, after = before + more[k];
    rows[k].lambda = std::clamp(after, rows[k].lo, rows[k].hi);
    // Without a bound in the way: more[k] itself, since the difference has the round-off of λ.
    apply_impulse(rows[k], rows[k].lambda == after ? more[k] : rows[k].lambda - before, V);
  }
}

/// Solves the rows for any initial λ and V; `solve` replaces velocities x by the impulses S⁻¹ x. The history has one entry.
/// Returns nothing if a λ is not strictly within its bounds, or if the residual exceeds stop.tolerance and the
/// round-off of Eq. (11.13). On failure, rows and V are unchanged if no solution was tried. Otherwise each λ is within
/// its bounds, and V is M⁻¹ Gᵀ λ. `friction`: contacts whose friction must also be within its cone, Eq. (9.3). `x` is
/// work space for one number per row.
template <int Dof, class Values, class Solve>
std::optional<SolveReport> solve_inside(std::vector<Row<Dof>>& rows, std::vector<Twist<Dof>>& V,
                                        const StopRule& stop, const std::vector<FrictionContact>& friction,
                                        Values& x, const Solve& solve) {
  for (std::size_t k = 0; k < rows.size(); ++k) x[k] = rows[k].B;
  solve(x);
  for (std::size_t k = 0; k < rows.size(); ++k)
    if (!(rows[k].lo < x[k] && x[k] < rows[k].hi)) return {};
  for (const auto& [k, mu] : friction)
    if (!(std::hypot(x[k + 1], x[k + 2]) < mu * x[k])) return {};

  std::fill(V.begin(), V.end(), Twist<Dof>::Zero());
  for (Row<Dof>& row : rows) row.lambda = 0;
  add_impulses(x, rows, V);
  set_residuals(rows, V, x);  // V contains the round-off of λ/m
  solve(x);
  add_impulses(x, rows, V);
  const double left = friction.empty() ? residual(rows, V) : residual_on_cones(friction, rows, V);
  if (!(left <= std::max(stop.tolerance, roundings(rows)))) return {};
  return SolveReport{.history = {left}, .converged = true};
}

}  // namespace spook
