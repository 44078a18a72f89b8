// Augmented vertex block descent: updates body by body, each to the velocity that minimises its own energy.
//
//   row      λ⁺ = clamp((λ + ρ (B - G V))/(1 + ρ Σ), lo, hi)      a spring of stiffness κ = ρ/(1 + ρ Σ), and a multiplier λ
//   body     V_b -= H⁻¹ (M V_b - Σ_k G_kᵀ λ⁺_k),  H = M + Σ_k κ_k G_kᵀ G_k
//   then     λ <- λ⁺, and ρ grows for rows that are not at a bound
//
// As ρ -> ∞ the spring is the row's own, 1/Σ, and needs no multiplier; for finite ρ the fixed point also is S λ = B.
// The paper works with positions, computes new Jacobians for each body, and increases ρ by β |C| with a β in the units
// of the scene. Here rows are constant during a step, and ρ grows by a factor from a tenth of 1/S_kk.
//
//   C. Giles, E. Diaz, C. Yuksel, Augmented vertex block descent, ACM Trans. Graph. 44 (2025).
#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "engine/linear/velocity_system.hpp"
#include "methods/methods.hpp"

namespace spook::plots {

namespace {

template <int Dof>
class BlockDescent {
 public:
  explicit BlockDescent(const SolverInput<Dof>& s) : s_(s), of_body_(s.V.size()), rho_(s.rows().size()) {
    for (int k = 0; k < std::ssize(s.rows()); ++k) {
      const spook::Row<Dof>& row = s.rows()[k];
      if (is_dynamic(s.bodies.motion.inverse_mass[row.i])) of_body_[row.i].push_back(k);
      if (is_dynamic(s.bodies.motion.inverse_mass[row.j])) of_body_[row.j].push_back(k);
      rho_[k] = first / row.diagonal;
    }
  }

  /// Updates every body once, then the multipliers. Returns the largest S_kk |Δλ| [m/s].
  double iterate() {
    for (std::size_t b = 0; b < of_body_.size(); ++b)
      if (!of_body_[b].empty()) descend(static_cast<int>(b));
    double most = 0;
    for (std::size_t k = 0; k < rho_.size(); ++k) {
      spook::Row<Dof>& row = s_.rows()[k];
      const double next = multiplier(k);
      most = std::max(most, row.diagonal * std::abs(next - row.lambda));
      row.lambda = next;
      if (row.lo < next && next < row.hi) rho_[k] = std::min(growth * rho_[k], last / row.diagonal);
    }
    return most;
  }

  /// The cost in multiply-adds: each row twice with its part of H, and once for its multiplier; a factorisation a body.
  double work() const {
    double sum = 0;
    for (const std::vector<int>& rows : of_body_)
      if (!rows.empty())
        sum += static_cast<double>(rows.size()) * (4 * Dof + Dof * (Dof + 1) / 2) + Dof * Dof * Dof / 6 +
               2 * Dof * Dof;
    return sum + 2 * Dof * static_cast<double>(rho_.size());
  }

 private:
  static constexpr double first = 0.1, growth = 2, last = 1e4;  // of 1/S_kk

  double multiplier(std::size_t k) const {
    const spook::Row<Dof>& row = s_.rows()[k];
    const double lacks = row.B - row.Gi.dot(s_.V[row.i]) - row.Gj.dot(s_.V[row.j]);
    return std::clamp((row.lambda + rho_[k] * lacks) / (1 + rho_[k] * row.Sigma), row.lo, row.hi);
  }

  void descend(int body) {
    Block<Dof> H = mass_of(s_.bodies.motion.inverse_mass[body]);
    Twist<Dof> force = -(H * s_.V[body]);
    for (const int k : of_body_[body]) {
      const spook::Row<Dof>& row = s_.rows()[k];
      const Twist<Dof>& G = row.i == body ? row.Gi : row.Gj;
      H += rho_[k] / (1 + rho_[k] * row.Sigma) * G * G.transpose();
      force += multiplier(k) * G;
    }
    s_.V[body] += H.llt().solve(force);
  }

  const SolverInput<Dof>& s_;
  std::vector<std::vector<int>> of_body_;  // rows that act on each body
  std::vector<double> rho_;
};

}  // namespace

template <int Dof>
Solver<Dof> avbd() {
  return {.solve = [](const SolverInput<Dof>& s) {
    BlockDescent<Dof> descent(s);
    SolveReport report;
    while (!report.converged && std::ssize(report.history) < s.stop.max_sweeps) {
      report.history.push_back(descent.iterate());
      report.converged = report.history.back() <= s.stop.tolerance;
    }
    SolverResult result(std::move(report));
    result.row_updates =
        std::llround(static_cast<double>(result.report.history.size()) * descent.work() / update_work<Dof>);
    return result;
  }};
}

template Solver<3> avbd<3>();
template Solver<6> avbd<6>();

}  // namespace spook::plots
