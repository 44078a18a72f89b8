// Anderson acceleration of sweeps of chapter 04, or of chapter 09 on cones: chapter 10.
//
//   sweep      T(λ), the result of a sweep from λ, and its change f = T(λ) - λ; the solution has f = 0
//   mixing     λ <- T(λ) - Σ γ_i ΔT_i,  with the γ that minimise |f - Σ γ_i Δf_i|; Δ over the last sweeps   Eq. (10.14)
//   |f|²       Σ S_kk f_k²
//   bounds     λ is clamped to its bounds, and friction projected on its disc                      Eq. (4.7), (9.4)
//   safeguard  if f exceeds twice the least so far, returns to T(λ) and makes plain sweeps, more of them each
//              time: up to eight. Ends with the λ of the least f since then
//
// There is a sweep between two mixtures. A history entry is the result of a sweep. Has no cache.
//
//   D. G. Anderson, Iterative procedures for nonlinear integral equations, J. ACM 12 (1965).
//   H. F. Walker, P. Ni, Anderson acceleration for fixed-point iterations, SIAM J. Numer. Anal. 49 (2011).
#include "engine/solvers/anderson.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "engine/solvers/cone_sweeps.hpp"
#include "engine/solvers/registry.hpp"

namespace spook {

namespace {

using Impulses = Eigen::VectorXd;  // √S_kk λ_k, so that |f|² is a sum of squares

/// The last sweeps: the change f of each, and the difference to the change of the sweep before.
class Memory {
 public:
  explicit Memory(Eigen::Index rows) : df_(rows, depth), dT_(rows, depth) {}

  void add(const Impulses& T, const Impulses& f) {
    if (f_.size() > 0) {
      const int column = differences_++ % depth;
      df_.col(column) = f - f_;
      dT_.col(column) = T - T_;
      for (int other = 0; other < size(); ++other)
        gram_(column, other) = gram_(other, column) = df_.col(column).dot(df_.col(other));
    }
    T_ = T;
    f_ = f;
  }
  void forget() {
    differences_ = 0;
    f_.resize(0);
  }
  int size() const { return std::min(differences_, depth); }

  Impulses mixed() const {  // Eq. (10.14)
    const int n = size();
    Eigen::MatrixXd A = gram_.topLeftCorner(n, n);
    A.diagonal() *= 1 + 1e-10;  // regular also for linearly dependent sweeps
    const Eigen::VectorXd gamma = A.ldlt().solve(df_.leftCols(n).transpose() * f_);
    return T_ - dT_.leftCols(n) * gamma;
  }

 private:
  static constexpr int depth = 5;

  Eigen::MatrixXd df_, dT_;
  Eigen::Matrix<double, depth, depth> gram_;  // Δf·Δf
  Impulses T_, f_;
  int differences_ = 0;
};

template <int Dof>
SolveReport accelerated(ConeSweeps<Dof>& sweeps, const StopRule& stop) {
  constexpr int longest_pause = 8;
  SolveReport report;
  Impulses x = sweeps.scaled_impulses(), before, best;
  Memory memory(x.size());
  double least = infinity, changed_before = infinity;
  bool mixed = false;
  int pause = 0, wait = 0;
  while (!report.converged && std::ssize(report.history) < stop.max_sweeps) {
    report.history.push_back(sweeps.sweep());
    report.converged = report.history.back() <= stop.tolerance;
    if (report.converged) break;
    const Impulses T = sweeps.scaled_impulses(), f = T - x;
    const double changed = f.norm();
    if (mixed && !(changed <= 2 * least)) {
      x = before;
      sweeps.start_from(x);
      memory.forget();
      least = infinity;
      wait = pause = std::min(2 * pause + 2, longest_pause);
      mixed = false;
      continue;
    }
    if (mixed && changed < changed_before) pause = 0;
    changed_before = changed;
    if (changed <= least) {
      least = changed;
      best = T;
    }
    memory.add(T, f);
    x = before = T;
    const bool last = std::ssize(report.history) == stop.max_sweeps;
    if (last && changed > least) sweeps.start_from(best);
    mixed = false;
    if (last || memory.size() == 0 || wait-- > 0) continue;
    wait = 0;
    const Impulses next = memory.mixed();
    if (!next.allFinite()) continue;
    sweeps.start_from(next);
    x = sweeps.scaled_impulses();
    mixed = true;
  }
  return report;
}

}  // namespace

template <int Dof>
SolveReport anderson_solve(const std::vector<FrictionContact>& friction, std::vector<Row<Dof>>& rows,
                           std::vector<Twist<Dof>>& V, const std::vector<InverseMass<Dof>>& inverse_mass,
                           const StopRule& stop) {
  ConeSweeps<Dof> sweeps(friction, rows, V, inverse_mass);
  SolveReport report = accelerated(sweeps, stop);
  sweeps.write_back();
  return report;
}

double error_of_accelerated(const std::vector<double>& history) {
  constexpr std::ptrdiff_t shortest = 8;
  constexpr double assumed = 0.98;
  if (std::ssize(history) < shortest) return history.back() / (1 - assumed);
  const auto quarter = [&](int n) { return history.begin() + std::ssize(history) * n / 4; };
  const double before = *std::min_element(quarter(1), quarter(2)),
               last = *std::min_element(quarter(3), history.end());
  const double rate = std::pow(last / before, 2.0 / static_cast<double>(history.size()));
  return rate < 1 ? history.back() / (1 - rate) : infinity;
}

template <int Dof>
Solver<Dof> anderson(FrictionModel model) {
  require_box_or_cone("anderson", model);
  const bool on_cones = model == FrictionModel::cone;
  return {.solve = [on_cones](const SolverInput<Dof>& s) -> SolverResult {
            const std::vector<FrictionContact> none;
            return anderson_solve(on_cones ? s.constraints.friction : none, s.rows(), s.V,
                                  s.bodies.motion.inverse_mass, s.stop);
          },
          .friction = on_cones ? FrictionModel::cone : FrictionModel::box};
}

template SolveReport anderson_solve<3>(const std::vector<FrictionContact>&, std::vector<Row<3>>&,
                                       std::vector<Twist<3>>&, const std::vector<InverseMass<3>>&,
                                       const StopRule&);
template SolveReport anderson_solve<6>(const std::vector<FrictionContact>&, std::vector<Row<6>>&,
                                       std::vector<Twist<6>>&, const std::vector<InverseMass<6>>&,
                                       const StopRule&);
template Solver<3> anderson<3>(FrictionModel);
template Solver<6> anderson<6>(FrictionModel);

}  // namespace spook
