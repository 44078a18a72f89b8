#include "engine/solvers/primal_interior_point.hpp"

#include <algorithm>
#include <cmath>

namespace spook {

namespace {

/// The rows and their factors. A row with lo = hi keeps its λ.
template <int Dof>
class BarrierSystem {
 public:
  BarrierSystem(const std::vector<Row<Dof>>& rows, const VelocitySystem<Dof>& velocity_system,
                const VelocityFactors& factors, std::size_t bodies)
      : rows_(rows), velocity_system_(velocity_system), factors_(factors), V_(bodies) {}

  /// Returns Σ̃ [1/kg].
  Vector softness(const Interior& now) const {
    Vector sum(now.lambda.size());
    for (std::size_t k = 0; k < rows_.size(); ++k)
      sum[k] = rows_[k].Sigma + now.push_lo[k] / now.room_lo[k] + now.push_hi[k] / now.room_hi[k];
    return sum;
  }

  Vector stiffness(const Vector& softness) const {
    Vector all = softness.cwiseInverse();
    for (std::size_t k = 0; k < rows_.size(); ++k)
      if (!is_open(k)) all[k] = 0;
    return all;
  }

  /// Returns B - S λ, Eq. (4.6).
  Vector residuals(const Vector& lambda) {
    Vector r = minus_S(lambda);
    for (std::size_t k = 0; k < rows_.size(); ++k) r[k] += rows_[k].B - rows_[k].Sigma * lambda[k];
    return r;
  }

  /// Returns Δλ of S̃ Δλ = r, refined up to so many times while that helps: Eq. (11.14), (11.15).
  Vector solve(Vector r, const Vector& softness, int refinements) {
    const Vector K = stiffness(softness), wanted = r;
    Vector x = Vector::Zero(r.size());
    double last = infinity;
    for (int n = 0; n <= refinements; ++n) {
      if (n > 0) r = wanted + minus_S(x) - softness.cwiseProduct(x);
      Vector right = Vector::Zero(velocity_system_.size());
      double most = 0;
      for (std::size_t k = 0; k < rows_.size(); ++k) {
        if (K[k] == 0) continue;
        most = std::max(most, std::abs(r[k]));
        velocity_system_.scatter(rows_[k], K[k] * r[k], right);
      }
      if (!(most < 0.1 * last)) break;
      last = most;
      const Vector v = factors_.solve(right);
      for (std::size_t k = 0; k < rows_.size(); ++k)
        x[k] += K[k] * (r[k] - velocity_system_.gather(rows_[k], v));
    }
    return x;
  }

  bool is_open(std::size_t k) const { return rows_[k].lo < rows_[k].hi; }

 private:
  /// Returns -G M⁻¹ Gᵀ x.
  Vector minus_S(const Vector& x) {
    std::fill(V_.begin(), V_.end(), Twist<Dof>::Zero());
    for (std::size_t k = 0; k < rows_.size(); ++k) apply_impulse(rows_[k], x[k], V_);
    Vector r(x.size());
    for (std::size_t k = 0; k < rows_.size(); ++k)
      r[k] = -rows_[k].Gi.dot(V_[rows_[k].i]) - rows_[k].Gj.dot(V_[rows_[k].j]);
    return r;
  }

  const std::vector<Row<Dof>>& rows_;
  const VelocitySystem<Dof>& velocity_system_;
  const VelocityFactors& factors_;
  std::vector<Twist<Dof>> V_;
};

/// Sets the starting point, Eq. (11.12). A row with lo = hi has no slacks.
template <int Dof>
Interior start(const std::vector<Row<Dof>>& rows) {
  const auto n = std::ssize(rows);
  SparseMatrix diagonal(n, n);
  diagonal.setIdentity();
  Vector B(n), lo(n), hi(n), guess(n);
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const Row<Dof>& row = rows[k];
    const bool open = row.lo < row.hi;
    diagonal.valuePtr()[k] = row.diagonal;
    B[k] = row.B;
    lo[k] = open ? row.lo : -infinity;
    hi[k] = open ? row.hi : infinity;
    guess[k] = row.lambda;
  }
  Interior now = interior_start(diagonal, B, lo, hi, guess);
  for (std::size_t k = 0; k < rows.size(); ++k)
    if (!(rows[k].lo < rows[k].hi)) now.lambda[k] = rows[k].lo;
  return now;
}

/// Returns Newton's step towards `target`: Eq. (11.8), (11.9). `residuals` is B - S λ.
template <int Dof>
Interior newton_step(const Interior& now, const Target& target, const Vector& residuals, const Vector& softness,
                     BarrierSystem<Dof>& system, int refinements) {
  const auto n = now.lambda.size();
  Interior step;
  step.lambda =
      system.solve(residuals + target.lo.cwiseQuotient(now.room_lo) - target.hi.cwiseQuotient(now.room_hi),
                   softness, refinements);
  step.room_lo = step.room_hi = step.push_lo = step.push_hi = Vector::Zero(n);
  for (Eigen::Index k = 0; k < n; ++k) {
    const double change = step.lambda[k];
    if (std::isfinite(now.room_lo[k])) {
      step.room_lo[k] = change;
      step.push_lo[k] = (target.lo[k] - now.push_lo[k] * change) / now.room_lo[k] - now.push_lo[k];
    }
    if (std::isfinite(now.room_hi[k])) {
      step.room_hi[k] = -change;
      step.push_hi[k] = (target.hi[k] + now.push_hi[k] * change) / now.room_hi[k] - now.push_hi[k];
    }
  }
  return step;
}

/// Returns μ, the mean product over all bounds; NaN if there are none.
double mean_product(const Interior& now) {
  double sum = 0;
  int bounds = 0;
  for (const auto& [room, push] :
       {std::pair(&now.room_lo, &now.push_lo), std::pair(&now.room_hi, &now.push_hi)})
    for (Eigen::Index k = 0; k < room->size(); ++k)
      if (std::isfinite((*room)[k])) sum += (*room)[k] * (*push)[k], ++bounds;
  return sum / bounds;
}

Interior moved(const Interior& now, const Interior& step, double share) {
  return {.lambda = now.lambda + share * step.lambda,
          .room_lo = now.room_lo + share * step.room_lo,
          .room_hi = now.room_hi + share * step.room_hi,
          .push_lo = now.push_lo + share * step.push_lo,
          .push_hi = now.push_hi + share * step.push_hi};
}

/// Computes two Newton steps, and takes the second: Eq. (11.10), (11.11). Then computes λ from the nearer bound.
template <int Dof>
Interior next(const std::vector<Row<Dof>>& rows, const Interior& now, const Vector& softness,
              BarrierSystem<Dof>& system) {
  const auto n = now.lambda.size();
  const Vector none = Vector::Zero(n), residuals = system.residuals(now.lambda);
  const Interior straight = newton_step(now, {none, none}, residuals, softness, system, 0);
  const double far = longest_step(now, straight);
  const double before = mean_product(now), after = mean_product(moved(now, straight, far));
  const Vector centre = Vector::Constant(n, before > 0 ? std::pow(after / before, 3) * before : 0);
  const Target target{.lo = centre - straight.room_lo.cwiseProduct(straight.push_lo),
                      .hi = centre - straight.room_hi.cwiseProduct(straight.push_hi)};
  const Interior step = newton_step(now, target, residuals, softness, system, 2);
  const double longest = longest_step(now, step);
  Interior there = moved(now, step, longest < 1 ? (0.9 + 0.0999 * far) * longest : 1);
  for (std::size_t k = 0; k < rows.size(); ++k) {
    double &below = there.room_lo[k], &above = there.room_hi[k];
    if (below < above) {
      there.lambda[k] = rows[k].lo + below;
      above = rows[k].hi - there.lambda[k];
    } else if (std::isfinite(above)) {
      there.lambda[k] = rows[k].hi - above;
      below = there.lambda[k] - rows[k].lo;
    }
  }
  return there;
}

/// Returns the predicted λ: at a bound whose multiplier exceeds the impulse that its slack would add, else λ itself.
template <int Dof>
double answer(const Row<Dof>& row, std::size_t k, const Interior& now) {
  if (now.push_lo[k] > row.diagonal * now.room_lo[k]) return row.lo;
  if (now.push_hi[k] > row.diagonal * now.room_hi[k]) return row.hi;
  return std::clamp(now.lambda[k], row.lo, row.hi);
}

}  // namespace

template <int Dof>
SolveReport primal_interior_point(std::vector<Row<Dof>>& rows, VelocitySystem<Dof>& velocity_system,
                                  std::vector<Twist<Dof>>& V, const StopRule& stop, VelocityFactors& factors) {
  BarrierSystem<Dof> system(rows, velocity_system, factors, V.size());
  Interior now = start(rows);
  SolveReport report;
  while (!report.converged && std::ssize(report.history) < stop.max_sweeps) {
    const Vector softness = system.softness(now);
    if (!factors.factorise(velocity_system.matrix(rows, system.stiffness(softness)))) return report;
    now = next(rows, now, softness, system);
    std::fill(V.begin(), V.end(), Twist<Dof>::Zero());
    for (std::size_t k = 0; k < rows.size(); ++k) {
      rows[k].lambda = answer(rows[k], k, now);
      apply_impulse(rows[k], rows[k].lambda, V);
    }
    report.history.push_back(residual(rows, V));
    report.converged = report.history.back() <= std::max(stop.tolerance, roundings(rows));
  }
  return report;
}

template SolveReport primal_interior_point<3>(std::vector<Row<3>>&, VelocitySystem<3>&, std::vector<Twist<3>>&,
                                              const StopRule&, VelocityFactors&);
template SolveReport primal_interior_point<6>(std::vector<Row<6>>&, VelocitySystem<6>&, std::vector<Twist<6>>&,
                                              const StopRule&, VelocityFactors&);

}  // namespace spook
