#include "engine/solvers/small_direct.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "common/require.hpp"
#include "engine/linear/schur_entry.hpp"
#include "engine/solvers/factor_cost.hpp"
#include "engine/solvers/solver_result.hpp"

namespace spook {

namespace {

using Few = std::array<double, most_dense_rows>;

/// Factorises S of all rows, Eq. (11.1); returns false if a pivot fails Eq. (11.4).
template <int Dof>
bool factorise(const std::vector<Row<Dof>>& rows, DenseLdlt& factors) {
  const int n = static_cast<int>(rows.size());
  factors.begin(n);
  for (int k = 0; k < n; ++k) {
    for (int l = 0; l < k; ++l) factors.at(k, l) = schur_entry(rows[k], rows[l]);
    factors.at(k, k) = schur_entry(rows[k], rows[k]) + rows[k].Sigma;
  }
  return factors.factorise();
}

/// Returns the residual of each row, Eq. (4.6).
template <int Dof>
Few residuals(const std::vector<Row<Dof>>& rows, const std::vector<Twist<Dof>>& V) {
  Few r;
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const Row<Dof>& row = rows[k];
    r[k] = row.B - row.Gi.dot(V[row.i]) - row.Gj.dot(V[row.j]) - row.Sigma * row.lambda;
  }
  return r;
}

template <int Dof>
void add(const Few& more, std::vector<Row<Dof>>& rows, std::vector<Twist<Dof>>& V) {
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const double before = rows[k].lambda, after = before + more[k];
    rows[k].lambda = std::clamp(after, rows[k].lo, rows[k].hi);
    // Without a bound in the way: more[k] itself, since the difference has the round-off of λ.
    apply_impulse(rows[k], rows[k].lambda == after ? more[k] : rows[k].lambda - before, V);
  }
}

}  // namespace

template <int Dof>
std::optional<SolveReport> small_direct(std::vector<Row<Dof>>& rows, std::vector<Twist<Dof>>& V,
                                        const StopRule& stop, const std::vector<FrictionContact>& friction) {
  require_positive("max_sweeps", stop.max_sweeps);
  require_not_negative("tolerance", stop.tolerance);
  const std::size_t n = rows.size();
  if (n == 0 || n > most_dense_rows) return {};
  if (n > most_dense_rows_on_bodies && wants_bodies(rows)) return {};
  DenseLdlt factors;
  if (!factorise(rows, factors)) return {};

  Few lambda;  // B, then S⁻¹ B
  for (std::size_t k = 0; k < n; ++k) lambda[k] = rows[k].B;
  factors.solve(lambda.data());
  for (std::size_t k = 0; k < n; ++k)
    if (!(rows[k].lo < lambda[k] && lambda[k] < rows[k].hi)) return {};
  for (const auto& [k, mu] : friction)
    if (!(std::hypot(lambda[k + 1], lambda[k + 2]) < mu * lambda[k])) return {};

  std::fill(V.begin(), V.end(), Twist<Dof>::Zero());
  for (Row<Dof>& row : rows) row.lambda = 0;
  add(lambda, rows, V);
  Few more = residuals(rows, V);  // V contains the round-off of λ/m
  factors.solve(more.data());
  add(more, rows, V);
  const double left = friction.empty() ? residual(rows, V) : residual_on_cones(friction, rows, V);
  if (!(left <= std::max(stop.tolerance, roundings(rows)))) return {};
  return SolveReport{.history = {left}, .converged = true};
}

template std::optional<SolveReport> small_direct<3>(std::vector<Row<3>>&, std::vector<Twist<3>>&,
                                                    const StopRule&, const std::vector<FrictionContact>&);
template std::optional<SolveReport> small_direct<6>(std::vector<Row<6>>&, std::vector<Twist<6>>&,
                                                    const StopRule&, const std::vector<FrictionContact>&);

}  // namespace spook
