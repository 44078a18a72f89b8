#include <algorithm>

#include "11_direct/direct.hpp"
#include "common/require.hpp"

namespace spook {

namespace {

/// The rows with lo < hi as a separate system, and V of the other rows.
template <int Dof>
struct OpenRows {
  std::vector<Row<Dof>> rows;
  std::vector<std::size_t> index;  ///< index of each in all rows
  Vector B, lo, hi;

  OpenRows(std::vector<Row<Dof>>& all, std::vector<Twist<Dof>>& V) {
    std::fill(V.begin(), V.end(), Twist<Dof>::Zero());
    rows.reserve(all.size()), index.reserve(all.size());
    for (std::size_t k = 0; k < all.size(); ++k) {
      all[k].lambda = all[k].lo;
      if (all[k].lo < all[k].hi) {
        rows.push_back(all[k]);
        index.push_back(k);
      } else {
        apply_impulse(all[k], all[k].lambda, V);
      }
    }
    const auto n = static_cast<Eigen::Index>(rows.size());
    B.resize(n), lo.resize(n), hi.resize(n);
    for (Eigen::Index k = 0; k < n; ++k) {
      const Row<Dof>& row = rows[static_cast<std::size_t>(k)];
      B[k] = row.B - row.Gi.dot(V[row.i]) - row.Gj.dot(V[row.j]);
      lo[k] = row.lo;
      hi[k] = row.hi;
    }
  }
};

/// Clamps λ to its bounds, stores it in the rows, and updates V.
template <int Dof>
void store(const OpenRows<Dof>& open, Vector& lambda, std::vector<Row<Dof>>& rows, std::vector<Twist<Dof>>& V) {
  for (std::size_t k = 0; k < open.rows.size(); ++k) {
    double& impulse = lambda[static_cast<Eigen::Index>(k)];
    impulse = std::clamp(impulse, open.rows[k].lo, open.rows[k].hi);
    rows[open.index[k]].lambda = impulse;
  }
  std::fill(V.begin(), V.end(), Twist<Dof>::Zero());
  for (const Row<Dof>& row : rows) apply_impulse(row, row.lambda, V);
}

/// Refines the solution, Eq. (11.14), since V contains the round-off of λ/m.
template <int Dof>
void refine(const OpenRows<Dof>& open, const Factors& factors, std::vector<Row<Dof>>& rows,
            std::vector<Twist<Dof>>& V) {
  Vector residual(open.B.size());
  for (std::size_t k = 0; k < open.rows.size(); ++k) {
    const Row<Dof>& row = rows[open.index[k]];
    residual[k] = row.B - row.Gi.dot(V[row.i]) - row.Gj.dot(V[row.j]) - row.Sigma * row.lambda;
  }
  const Vector more = factors.ldlt.solve(residual);
  for (std::size_t k = 0; k < open.rows.size(); ++k) {
    Row<Dof>& row = rows[open.index[k]];
    row.lambda = std::clamp(row.lambda + more[k], row.lo, row.hi);
    apply_impulse(row, more[k], V);
  }
}

}  // namespace

template <int Dof>
SolveReport direct_solve(std::vector<Row<Dof>>& rows, std::vector<Twist<Dof>>& V, const StopRule& stop,
                         Factors& factors) {
  require_positive("max_sweeps", stop.max_sweeps);
  require_not_negative("tolerance", stop.tolerance);

  SolveReport report;
  const OpenRows<Dof> open(rows, V);
  report.converged = open.rows.empty();
  if (report.converged) return report;

  const SparseMatrix S = schur_complement(open.rows);
  Vector lambda = Vector::Zero(open.B.size());
  if (factorise(S, factors)) {
    lambda = factors.ldlt.solve(open.B);
    const bool inside = (lambda.array() > open.lo.array() && lambda.array() < open.hi.array()).all();
    store(open, lambda, rows, V);
    if (inside) refine(open, factors, rows, V);
    report.history.push_back(residual(rows, V));
    report.converged = report.history.back() <= std::max(stop.tolerance, roundings(S, open.B, lambda));
    if (report.converged) return report;
  }
  const SolveReport inner = interior_solve(S, open.B, open.lo, open.hi, stop, lambda, factors);
  store(open, lambda, rows, V);
  const auto append = [&](const SolveReport& more) {
    report.history.insert(report.history.end(), more.history.begin(), more.history.end());
    report.converged = more.converged;
  };
  append(inner);
  report.trouble = inner.trouble;
  if (!inner.trouble.empty()) append(solve(rows, V, stop));
  return report;
}

template SolveReport direct_solve<3>(std::vector<Row<3>>&, std::vector<Twist<3>>&, const StopRule&, Factors&);
template SolveReport direct_solve<6>(std::vector<Row<6>>&, std::vector<Twist<6>>&, const StopRule&, Factors&);

}  // namespace spook
