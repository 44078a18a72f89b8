#include <algorithm>

#include "11_direct/direct.hpp"
#include "common/require.hpp"

namespace spook {

namespace {

/// Returns `lambda` clamped to the bounds; a NaN stays a NaN.
Vector clamped(const Vector& lambda, const Vector& lo, const Vector& hi) {
  Vector inside = lambda;
  for (Eigen::Index k = 0; k < inside.size(); ++k) inside[k] = std::clamp(inside[k], lo[k], hi[k]);
  return inside;
}

/// Returns the residual of Eq. (4.8).
double residual(const SparseMatrix& S, const Vector& B, const Vector& lo, const Vector& hi,
                const Vector& lambda) {
  const Vector S_kk = S.diagonal(), r = B - S.selfadjointView<Eigen::Lower>() * lambda;
  const Vector next = clamped(lambda + r.cwiseQuotient(S_kk), lo, hi);
  return S_kk.cwiseProduct(next - lambda).cwiseAbs().maxCoeff<Eigen::PropagateNaN>();
}

}  // namespace

SolveReport interior_solve(const SparseMatrix& S, const Vector& B, const Vector& lo, const Vector& hi,
                           const StopRule& stop, Vector& lambda, Factors& factors) {
  require_positive("max_sweeps", stop.max_sweeps);
  require_not_negative("tolerance", stop.tolerance);

  SolveReport report;
  report.converged = B.size() == 0;
  if (report.converged) return report;
  Interior now = interior_start(S, B, lo, hi, lambda);
  double best = infinity;
  lambda = clamped(lambda, lo, hi);
  while (!report.converged && std::ssize(report.history) < stop.max_sweeps) {
    if (!factorise(barrier_matrix(S, now), factors)) {
      report.trouble = "a pivot of S is not sound";
      return report;
    }
    now = interior_step(S, B, lo, hi, now, factors);
    const Vector inside = clamped(now.lambda, lo, hi);
    report.history.push_back(residual(S, B, lo, hi, inside));
    if (!(report.history.back() < best)) continue;
    best = report.history.back();
    lambda = inside;
    report.converged = best <= std::max(stop.tolerance, roundings(S, B, lambda));
  }
  if (!report.converged) report.trouble = "not solved after the factorisations that were allowed";
  return report;
}

}  // namespace spook
