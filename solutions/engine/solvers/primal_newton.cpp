#include "engine/solvers/primal_newton.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/solvers/primal_interior_point.hpp"

namespace spook {

namespace {

/// Impulses of rows, and the velocities that they cause.
template <int Dof>
struct Iterate {
  Vector lambda;
  std::vector<Twist<Dof>> V;

  void move(const Row<Dof>& row, Eigen::Index k, double to) {
    if (to == lambda[k]) return;
    apply_impulse(row, to - lambda[k], V);
    lambda[k] = to;
  }
  double row_residual(const Row<Dof>& row, Eigen::Index k) const {  // Eq. (4.6)
    return row.B - row.Gi.dot(V[row.i]) - row.Gj.dot(V[row.j]) - row.Sigma * lambda[k];
  }
  /// Returns the energy ½ λᵀ S λ - Bᵀ λ [J], which the solution minimises.
  double energy(const std::vector<Row<Dof>>& rows) const {
    double sum = 0;
    for (std::size_t k = 0; k < rows.size(); ++k) sum -= lambda[k] * (rows[k].B + row_residual(rows[k], k)) / 2;
    return sum;
  }
};

/// The active set. Free rows are those that stay strictly between their bounds in the update of Eq. (4.7).
struct ActiveSet {
  Vector stiffness;  ///< Σ⁻¹; 0 for a row that is not free
  Vector held_at;    ///< λ of a row that is not free: the bound of the update
};

template <int Dof>
ActiveSet active_set(const std::vector<Row<Dof>>& rows, const Iterate<Dof>& now) {
  ActiveSet found{Vector::Zero(std::ssize(rows)), now.lambda};
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const Row<Dof>& row = rows[k];
    const auto within = [&](double lambda) { return row.lo < lambda && lambda < row.hi; };
    if (!within(now.lambda[k])) continue;
    const double updated = now.lambda[k] + now.row_residual(row, k) / row.diagonal;
    if (within(updated))
      found.stiffness[k] = 1 / row.Sigma;
    else
      found.held_at[k] = std::clamp(updated, row.lo, row.hi);
  }
  return found;
}

/// Solves the free rows, with fixed λ of the others: Eq. (11.15), and (11.14) while this helps and a residual exceeds
/// `enough` [m/s].
template <int Dof>
void solve_free(const std::vector<Row<Dof>>& rows, const VelocitySystem<Dof>& velocity_system,
                const Vector& stiffness, const VelocityFactors& factors, double enough, Iterate<Dof>& state) {
  constexpr int refinements = 8;
  Vector residuals = Vector::Zero(stiffness.size());
  double last = infinity;
  for (int n = 0; n <= refinements; ++n) {
    Vector right = Vector::Zero(velocity_system.size());
    for (std::size_t k = 0; k < rows.size(); ++k) {
      if (stiffness[k] == 0) continue;
      residuals[k] = state.row_residual(rows[k], k);
      velocity_system.scatter(rows[k], stiffness[k] * residuals[k], right);
    }
    const double most = residuals.cwiseAbs().maxCoeff();
    if (!(most < 0.1 * last) || (n > 0 && most <= enough)) return;
    last = most;
    const Vector v = factors.solve(std::move(right));
    for (std::size_t k = 0; k < rows.size(); ++k)
      if (stiffness[k] != 0)
        state.move(rows[k], k,
                   state.lambda[k] + stiffness[k] * (residuals[k] - velocity_system.gather(rows[k], v)));
  }
}

/// Returns the state at the fraction `share` between two states, clamped to the bounds. Updates V of the first state,
/// since V of the second contains the round-off of larger impulses.
template <int Dof>
Iterate<Dof> projected(const std::vector<Row<Dof>>& rows, const Iterate<Dof>& from, const Iterate<Dof>& to,
                       double share) {
  Iterate<Dof> state = from;
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const double lambda = from.lambda[k] + share * (to.lambda[k] - from.lambda[k]);
    state.move(rows[k], k, std::clamp(lambda, rows[k].lo, rows[k].hi));
  }
  return state;
}

/// Moves towards the solution of the free rows as long as the energy falls, or rises by no more than round-off. A start
/// from the last step may have no more energy to lose.
template <int Dof>
Iterate<Dof> step(const std::vector<Row<Dof>>& rows, const VelocitySystem<Dof>& velocity_system,
                  const ActiveSet& active, const VelocityFactors& factors, double enough,
                  const Iterate<Dof>& now) {
  Iterate<Dof> there = now;
  for (std::size_t k = 0; k < rows.size(); ++k)
    if (active.stiffness[k] == 0) there.move(rows[k], k, active.held_at[k]);
  solve_free(rows, velocity_system, active.stiffness, factors, enough, there);
  double share = 1;
  Iterate<Dof> inside = projected(rows, now, there, share);
  // If no row moved to a bound or was clamped, the free rows have the least energy.
  if (active.held_at == now.lambda && inside.lambda == there.lambda) return inside;
  constexpr double rounding = 1e-14;  // of a sum whose terms mostly have one sign
  const double energy = now.energy(rows), most = energy + rounding * std::abs(energy);
  while (inside.energy(rows) > most && share > 1e-2) inside = projected(rows, now, there, share /= 2);
  return inside;
}

template <int Dof>
Vector impulses_of(const std::vector<Row<Dof>>& rows) {
  Vector lambda(std::ssize(rows));
  for (std::size_t k = 0; k < rows.size(); ++k) lambda[k] = rows[k].lambda;
  return lambda;
}

/// Repeats Newton steps with the current active set while they make progress.
template <int Dof>
SolveReport newton_solve(std::vector<Row<Dof>>& rows, VelocitySystem<Dof>& velocity_system,
                         std::vector<Twist<Dof>>& V, const StopRule& stop, VelocityFactors& factors) {
  constexpr int sweeps = 4, most_in_vain = 2;
  // In units of round-off: with the right active set the residual ends far below this. A tower under 10⁸:1 whose
  // residual equals round-off may be about to buckle.
  constexpr double settled = 0.1;
  SolveReport report;
  const auto enough = [&] { return std::max(stop.tolerance, settled * roundings(rows)); };
  double best = infinity;
  for (int in_vain = 0; in_vain < most_in_vain && std::ssize(report.history) < stop.max_sweeps;) {
    const Iterate<Dof> now{impulses_of(rows), V};
    const ActiveSet free = active_set(rows, now);
    if (!factors.factorise(velocity_system.matrix(rows, free.stiffness))) return report;
    Iterate<Dof> next = step(rows, velocity_system, free, factors, enough(), now);
    for (std::size_t k = 0; k < rows.size(); ++k) rows[k].lambda = next.lambda[k];
    V = std::move(next.V);
    report.history.push_back(residual(rows, V));
    report.converged = report.history.back() <= enough();
    if (report.converged) return report;
    if (!(report.history.back() < best / 2)) ++in_vain;
    best = std::min(best, report.history.back());
    for (int n = 0; n < sweeps; ++n) sweep(rows, V);
  }
  return report;
}

}  // namespace

template <int Dof>
std::optional<SolveReport> primal_newton(std::vector<Row<Dof>>& rows,
                                         const std::vector<InverseMass<Dof>>& inverse_mass,
                                         std::vector<Twist<Dof>>& V, const StopRule& stop,
                                         PrimalFactors<Dof>& kept) {
  const bool soft = std::all_of(rows.begin(), rows.end(), [](const Row<Dof>& row) { return row.Sigma > 0; });
  if (!soft) return std::nullopt;
  auto& [velocity_system, factors] = kept;
  velocity_system.begin(rows, inverse_mass);
  const Iterate<Dof> before{impulses_of(rows), V};
  SolveReport report = newton_solve(rows, velocity_system, V, stop, factors);
  if (!report.converged) {
    const SolveReport from_within = primal_interior_point(rows, velocity_system, V, stop, factors);
    report.history.insert(report.history.end(), from_within.history.begin(), from_within.history.end());
    report.converged = from_within.converged;
  }
  if (report.converged) return report;
  for (std::size_t k = 0; k < rows.size(); ++k) rows[k].lambda = before.lambda[k];
  V = before.V;
  return std::nullopt;
}

template std::optional<SolveReport> primal_newton<3>(std::vector<Row<3>>&, const std::vector<InverseMass<3>>&,
                                                     std::vector<Twist<3>>&, const StopRule&,
                                                     PrimalFactors<3>&);
template std::optional<SolveReport> primal_newton<6>(std::vector<Row<6>>&, const std::vector<InverseMass<6>>&,
                                                     std::vector<Twist<6>>&, const StopRule&,
                                                     PrimalFactors<6>&);

}  // namespace spook
