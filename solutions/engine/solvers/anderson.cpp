// Anderson acceleration: sweeps of chapter 04, or of chapter 09 on cones, mixed so that less is left to change. Chapter 10.
//
//   sweep      T(λ), what a sweep makes of λ, and f = T(λ) - λ, what it changes; solved where f = 0
//   mixed      λ <- T(λ) - Σ γ_i ΔT_i,  with the γ that make |f - Σ γ_i Δf_i| least; Δ over the last sweeps      Eq. (10.14)
//   |f|²       Σ S_kk f_k²
//   inside     then clamped to its bounds, friction onto its disc                                  Eq. (4.7), (9.4)
//   safe       where f is then more than twice the least so far, back to T(λ), and plain sweeps, twice as many each time;
//              and it ends where f was least since then
//
// Between two mixtures there is a sweep. One entry of its history is what a sweep returned. Keeps
// nothing.
//
//   D. G. Anderson, Iterative procedures for nonlinear integral equations, J. ACM 12 (1965).
//   H. F. Walker, P. Ni, Anderson acceleration for fixed-point iterations, SIAM J. Numer. Anal. 49 (2011).
#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "09_better_friction/better_friction.hpp"
#include "engine/solvers/registry.hpp"

namespace spook {

namespace {

using Impulses = Eigen::VectorXd;  // √S_kk λ_k, so that |f|² is a sum of squares

/// The last sweeps: what each changed, and by how much more or less than the one before.
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
    A.diagonal() *= 1 + 1e-10;  // sweeps that repeat each other have an answer, too
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
class Sweeps {
 public:
  Sweeps(const SolverInput<Dof>& s, bool on_cones) : s_(s), on_cones_(on_cones) {}

  double sweep() const {
    return on_cones_ ? sweep_on_cones(s_.rubbing, s_.rows, s_.V) : spook::sweep(s_.rows, s_.V);
  }
  Impulses impulses() const {
    Impulses all(std::ssize(s_.rows));
    for (std::size_t k = 0; k < s_.rows.size(); ++k)
      all[k] = std::sqrt(s_.rows[k].diagonal) * s_.rows[k].lambda;
    return all;
  }
  /// The nearest that is allowed, and V as it makes it.
  void start_from(const Impulses& impulses) const {
    for (std::size_t k = 0; k < s_.rows.size(); ++k)
      s_.rows[k].lambda = impulses[k] / std::sqrt(s_.rows[k].diagonal);
    auto contact = s_.rubbing.begin();
    for (std::size_t k = 0; k < s_.rows.size(); ++k) {
      s_.rows[k].lambda = std::clamp(s_.rows[k].lambda, s_.rows[k].lo, s_.rows[k].hi);
      if (!on_cones_ || contact == s_.rubbing.end() || contact->normal != k) continue;
      double &along1 = s_.rows[k + 1].lambda, &along2 = s_.rows[k + 2].lambda;
      const Vec2 inside = onto_disc({along1, along2}, contact->mu * s_.rows[k].lambda);
      along1 = inside[0], along2 = inside[1];
      ++contact, k += 2;
    }
    std::fill(s_.V.begin(), s_.V.end(), Twist<Dof>::Zero());
    for (const Row<Dof>& row : s_.rows) apply_impulse(row, row.lambda, s_.V);
  }

 private:
  const SolverInput<Dof>& s_;
  bool on_cones_;
};

template <int Dof>
SolveReport accelerated(const Sweeps<Dof>& sweeps, const StopRule& stop) {
  constexpr int longest_pause = 8;
  SolveReport report;
  Impulses x = sweeps.impulses(), before, best;
  Memory memory(x.size());
  double least = infinity, changed_before = infinity;
  bool mixed = false;
  int pause = 0, wait = 0;
  while (!report.converged && std::ssize(report.history) < stop.max_sweeps) {
    report.history.push_back(sweeps.sweep());
    report.converged = report.history.back() <= stop.tolerance;
    if (report.converged) break;
    const Impulses T = sweeps.impulses(), f = T - x;
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
    x = sweeps.impulses();
    mixed = true;
  }
  return report;
}

}  // namespace

template <int Dof>
Solver<Dof> anderson(FrictionModel model) {
  const bool on_cones = model == FrictionModel::cone;
  return {.solve = [on_cones](const SolverInput<Dof>& s) -> SolverResult {
            return accelerated(Sweeps<Dof>(s, on_cones), s.stop);
          },
          .friction = on_cones ? FrictionModel::cone : FrictionModel::box};
}

template Solver<3> anderson<3>(FrictionModel);
template Solver<6> anderson<6>(FrictionModel);

}  // namespace spook
