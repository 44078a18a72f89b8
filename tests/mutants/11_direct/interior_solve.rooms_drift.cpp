// Wrong: lets λ and its rooms drift apart.
// Killed by: InteriorSolve.TakesAnyGuess
// Says: drift apart by roundings of what was large once
#include <algorithm>
#include <cmath>

#include "11_direct/direct.hpp"
#include "common/require.hpp"

namespace spook {

namespace {

/// S λ = B within bounds.
struct Problem {
  const SparseMatrix& S;
  const Vector &B, &lo, &hi;
  Vector diagonal = S.diagonal();

  /// The nearest to `lambda` that is within the bounds; a NaN stays a NaN.
  Vector within_bounds(const Vector& lambda) const {
    Vector inside = lambda;
    for (Eigen::Index k = 0; k < inside.size(); ++k) inside[k] = std::clamp(inside[k], lo[k], hi[k]);
    return inside;
  }

  /// Eq. (4.8).
  double residual(const Vector& lambda) const {
    const Vector r = B - S.selfadjointView<Eigen::Lower>() * lambda;
    const Vector next = within_bounds(lambda + r.cwiseQuotient(diagonal));
    return diagonal.cwiseProduct(next - lambda).cwiseAbs().template maxCoeff<Eigen::PropagateNaN>();
  }
};

/// Each λ well within its bounds, and every s z the same: an energy that is typical of the problem.
Interior start(const Problem& problem, const Vector& guess) {
  const Vector none = Vector::Zero(problem.B.size()), &S_kk = problem.diagonal;
  const Vector smallest = problem.within_bounds(none), likely = problem.within_bounds(guess);
  const Vector energies =
      problem.B.cwiseAbs2().cwiseQuotient(S_kk) + S_kk.cwiseProduct(smallest.cwiseAbs2() + likely.cwiseAbs2());
  const double energy = energies.maxCoeff() > 0 ? energies.maxCoeff() : 1;

  Interior now{.lambda = none, .room_lo = none, .room_hi = none, .push_lo = none, .push_hi = none};
  for (Eigen::Index k = 0; k < none.size(); ++k) {
    const double lo = problem.lo[k], hi = problem.hi[k];
    const double room = std::min(std::sqrt(energy / S_kk[k]), (hi - lo) / 2);
    now.lambda[k] = std::isfinite(lo) ? lo + room : std::isfinite(hi) ? hi - room : 0;
    now.room_lo[k] = now.lambda[k] - lo;
    now.room_hi[k] = hi - now.lambda[k];
    now.push_lo[k] = energy / now.room_lo[k];
    now.push_hi[k] = energy / now.room_hi[k];
  }
  return now;
}

Interior moved(const Interior& now, const Interior& step, double share) {
  return {.lambda = now.lambda + share * step.lambda,
          .room_lo = now.room_lo + share * step.room_lo,
          .room_hi = now.room_hi + share * step.room_hi,
          .push_lo = now.push_lo + share * step.push_lo,
          .push_hi = now.push_hi + share * step.push_hi};
}

/// μ, the mean of s z over the bounds that there are; 0 when there are none.
double mean_product(const Interior& now) {
  double sum = 0;
  int bounds = 0;
  const auto add = [&](const Vector& room, const Vector& push) {
    for (Eigen::Index k = 0; k < room.size(); ++k)
      if (std::isfinite(room[k])) sum += room[k] * push[k], ++bounds;
  };
  add(now.room_lo, now.push_lo);
  add(now.room_hi, now.push_hi);
  return bounds > 0 ? sum / bounds : 0;
}

/// The next point. A step straight to the solution tells how far one can get, and what it gets wrong.
Interior next(const Problem& problem, const Interior& now, const Factors& factors) {
  const Vector none = Vector::Zero(problem.B.size());
  const Interior straight = newton_step(problem.S, problem.B, now, {.lo = none, .hi = none}, factors);
  const double before = mean_product(now);
  const double far = longest_step(now, straight);
  const double after = mean_product(moved(now, straight, far));
  const Vector centre = Vector::Constant(none.size(), before > 0 ? std::pow(after / before, 3) * before : 0);
  const Target target{.lo = centre - far * straight.room_lo.cwiseProduct(straight.push_lo),  // Eq. (11.11)
                      .hi = centre - far * straight.room_hi.cwiseProduct(straight.push_hi)};

  const Interior step = newton_step(problem.S, problem.B, now, target, factors);
  const double longest = longest_step(now, step);
  return moved(now, step, longest < 1 ? 0.999 * longest : 1);  // rooms stay positive
}

}  // namespace

SolveReport interior_solve(const SparseMatrix& S, const Vector& B, const Vector& lo, const Vector& hi,
                           const StopRule& stop, Vector& lambda, Factors& factors) {
  require_positive("max_sweeps", stop.max_sweeps);
  require_not_negative("tolerance", stop.tolerance);

  const Problem problem{S, B, lo, hi};
  SolveReport report;
  report.converged = B.size() == 0;
  if (report.converged) return report;
  Interior now = start(problem, lambda);
  double best = infinity;
  lambda = problem.within_bounds(lambda);
  while (!report.converged && std::ssize(report.history) < stop.max_sweeps) {
    if (!factorise(barrier_matrix(S, now), factors)) {
      report.trouble = "a pivot of S is not sound";
      return report;
    }
    now = next(problem, now, factors);
    const Vector inside = problem.within_bounds(now.lambda);
    report.history.push_back(problem.residual(inside));
    if (!(report.history.back() < best)) continue;
    best = report.history.back();
    lambda = inside;
    report.converged = best <= std::max(stop.tolerance, roundings(S, B, lambda));
  }
  if (!report.converged) report.trouble = "not solved after the factorisations that were allowed";
  return report;
}

}  // namespace spook
